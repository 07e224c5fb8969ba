"""Live pages: a scene as one HTML file that moves in the browser.

page         `write_page`: the file, and what its scripts read.
assembly     One HTML file of parts, scripts and data.
contact      Pages of solved contacts: maps over load and depth.
film_page    Data of the page of a film; what those of the devices share with it.
valve_page   Data of the page of the fuel injector.
mirror_page  Data of the page of the micromirror.
fmu_files    FMUs that a page offers.
scene        Scenes that a page can carry, and the numbers that its kernel reads.
sliders      Quantities that a page moves: fields of the scene, with labels, units and ranges.
family       Tables of the kernel over a grid of geometry, angles and humidity, and their error.
fixed        Tables with the same number of nodes whatever the scene.
validity     Numbers of validity, measured on the plan.
module       The C kernel as a WebAssembly module.
kernel       Entry points in C: film, valve, mirror.
template     The page: HTML, CSS, and JavaScript with a view for each kind of page.
"""
