"""Live pages: a scene as one HTML file that runs the C kernel in the browser.

`page` writes the file, `module` compiles the kernel to WebAssembly, `scene` refuses what a page
cannot carry and makes the numbers the kernel reads. `sliders` lists what can be moved; `family` and
`fixed` tabulate over a grid, with its error, what the kernel does not compute, `liquid` over the
temperature, and `validity` the numbers of validity. `kernel` has the calls in C, `template` the
page.
"""
