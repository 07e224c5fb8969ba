"""Live pages: a scene as one HTML file that runs the C kernel in the browser.

page      `write_page`: the file, and what its scripts read.
scene     Scenes that a page can carry, and the numbers that its kernel reads.
sliders   Quantities that a page moves: fields of the scene, with labels, units and ranges.
family    Tables of the kernel over a grid of geometry, angles and humidity, and their error.
fixed     Tables with the same number of nodes whatever the scene.
validity  Numbers of validity, measured on the plan.
module    The C kernel as a WebAssembly module.
kernel    Entry points in C.
template  The page: HTML, CSS and JavaScript.
"""
