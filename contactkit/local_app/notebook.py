"""The app as a notebook of marimo: its cells join what the other modules of this folder make."""

import marimo

__generated_with = "0.25.2"
app = marimo.App(width="full", app_title="contactkit")


@app.cell
def _():
    import marimo as mo

    from contactkit.local_app import computed, desk, elements, form, layout, movers

    here = desk.current_desk()
    return computed, desk, elements, form, here, layout, mo, movers


@app.cell
def _(desk, here, layout, mo):
    half = mo.ui.radio(desk.HALVES, value=here.half, inline=True, label="without a file")
    drop = layout.drop_area()
    layout.head(half, drop)
    return drop, half


@app.cell
def _(drop, half, here):
    start = here.begin(half.value, drop.value)
    kept = {}  # texts that were typed, for when the form is made anew
    return kept, start


@app.cell
def _(elements, start):
    picks = elements.choice_elements(start.choices)
    return (picks,)


@app.cell
def _(elements, picks):
    chosen = elements.chosen_of(picks.value)
    return (chosen,)


@app.cell
def _(chosen, form, start):
    parts = form.parts_of(start.scene, chosen)
    return (parts,)


@app.cell
def _(desk, mo, start):
    slide = mo.ui.switch(
        value=not desk.is_contact(start.scene), label="move the main quantities by sliders"
    )
    None if desk.is_contact(start.scene) else slide
    return (slide,)


@app.cell
def _(desk, elements, form, kept, movers, parts, slide, start):
    sliders = ()
    if slide.value and not desk.is_contact(start.scene):
        sliders = movers.movers_of(form.made_of(start.scene, parts, kept), parts, kept)
    fields = elements.field_elements(parts, kept, sliders)
    return fields, sliders


@app.cell
def _(elements, fields, kept, sliders):
    values = elements.values_of(fields.value, sliders)
    kept.update(values)
    return (values,)


@app.cell
def _(computed, form, parts, start, values):
    made = form.made_of(start.scene, parts, values)
    surfaces, amiss = computed.surfaces_of(made.opened)
    problems = form.with_problem(made.problems, amiss, parts)
    return made, problems, surfaces


@app.cell
def _(fields, layout, parts, picks, problems, start):
    layout.form(start, picks, parts, fields, problems)
    return


@app.cell
def _(layout, surfaces):
    layout.surfaces(surfaces)
    return


@app.cell
def _(desk, mo, problems, start):
    asks = desk.is_contact(start.scene)
    solve = mo.ui.run_button(label="Solve", kind="success", disabled=bool(problems))
    solve if asks else None
    return asks, solve


@app.cell
def _(asks, solve):
    is_asked = solve.value or not asks
    return (is_asked,)


@app.cell
def _(computed, is_asked, layout, made, mo, problems):
    mo.stop(bool(problems) or not is_asked)
    with layout.working("solving"):
        answer = computed.answer_of(made.opened)
    return (answer,)


@app.cell
def _(answer, layout):
    shown = layout.picture_choice(answer)
    return (shown,)


@app.cell
def _(answer, layout, shown):
    layout.answer(answer, shown)
    return


@app.cell
def _(answer, asks, mo):
    more = mo.ui.run_button(label="Area over load, with its error")
    more if asks and answer.result is not None else None
    return (more,)


@app.cell
def _(more):
    is_curve_asked = more.value
    return (is_curve_asked,)


@app.cell
def _(answer, computed, is_curve_asked, layout, mo):
    mo.stop(not is_curve_asked or answer.result is None)
    with layout.working("area over load"):
        curve = computed.curve_of(answer.result)
    return (curve,)


@app.cell
def _(curve, layout):
    layout.curve(curve)
    return


@app.cell
def _(answer, layout, made):
    layout.downloads(made, answer)
    return


@app.cell
def _(answer, mo):
    build = mo.ui.run_button(label="Build FMU")
    native = mo.ui.checkbox(label="in C (extra native)")
    mo.hstack([build, native], justify="start") if answer.result is not None else None
    return build, native


@app.cell
def _(build, layout, made, mo, native):
    mo.stop(not build.value)
    layout.fmu(made, native.value)
    return


if __name__ == "__main__":
    app.run()
