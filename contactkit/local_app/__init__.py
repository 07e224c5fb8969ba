"""The local app of ``contactkit app``: a page on this machine with a form for each scene.

widgets   Widgets of a class: label, unit, range and choices of each field.
form      A scene as choices and widgets, and the scene that their texts make.
movers    Sliders of a separation, with the ranges of its live page.
desk      What was opened or dropped, and the scene that a form begins with.
computed  Surface, result, and area over load with its error.
shown     Numbers, validity and figures of a result, as rows and pictures.
exports   Scene file, report, columns, FMU.
elements  Elements of marimo for choices and widgets.
layout    Layout of the page.
notebook  The app itself: cells that join these modules.
server    The server, on this machine only.
"""
