"""What the documentation in an FMU says about stepping it with something else."""

from __future__ import annotations

__all__ = ["CONVENTIONS", "coupling_note"]

CONVENTIONS = (
    "All values are in SI units, angles in radians; the unit in the third column is only for "
    "showing. A gap is the distance of the bodies, a speed is positive while it opens the gap; "
    "the sign of each force stands in its description. Times of events are those of the host's "
    "clock, -1 before there was one. The variables that cross the interface are one terminal, "
    "flange, in terminalsAndIcons/terminalsAndIcons.xml."
)

_STEP = "2 sqrt(m/k)"
_NOTES: dict[str, tuple[str, ...]] = {
    "stiction-mass": (
        "The mass is inside, and the film with it: no communication step is too long for them. "
        "Give the pull at the start of a step as F_ext and its rate as dF_ext; then the pull is a "
        "straight line within the step, and the error falls with the square of the step. With "
        "dF_ext left at 0 the pull is held, and the error falls with the step only.",
        f"What is outside still limits the step: a spring or stop of stiffness k to {_STEP}, of "
        "which a tenth is good. Step the tool that pulls first, this FMU last.",
    ),
    "valve-drive": (
        "Set h and v at the start of a step; within it the gap runs on at that speed. F_ext at the "
        "start of the step and dF_ext after it are what a stiction-mass takes, which steps last.",
        f"The stop is stiff: the step must stay below {_STEP} of the mass and k_stop, and a tenth "
        "of that is good. Beyond it a blow on the stop feeds on itself.",
    ),
    "stiction-force": (
        "The mass is outside. Set h and v at the end of the step to come. A film is a damper c of "
        "5e7 to 3e10 N.s/m: forces exchanged once in a step are stable only below H_stable = m/c, "
        "and beyond it they may look like an answer: a release after one step. Watch in_doubt and "
        "coupling_error, and the log category logCoupling.",
        "Use a master that repeats a step until both sides agree on the impulse (J, F_mean), such "
        "as contactkit.fmu.master.couple, or take stiction-mass, which has the mass inside and asks for "
        "no small step.",
    ),
    "tip-contact": (
        "Set height, speed and acceleration of the root at the start of a step, and take F_mean, "
        "the mean over it, so that no impulse is lost; a host that cannot repeat its step takes F "
        "at the end of it.",
        "The longest stable step is that of the mass outside on the springs, 2 sqrt(M/(N k)); the "
        "film does not limit it.",
    ),
    "contact-stop": (
        "The force follows the inputs at once. As for any stiff spring the step must stay below "
        f"{_STEP} of the mass outside and the stiffness k that the FMU gives; a tenth is good.",
    ),
}
_EARLY: dict[str, tuple[str, ...]] = {
    "stiction-mass": (
        "A host that uses event mode and allows early return is handed the step back where the "
        "film breaks; t_break holds that time for all others.",
    ),
    "valve-drive": (
        "A host that uses event mode and allows early return is handed the step back where the "
        "voltage switches.",
    ),
}
_ANY = ("A host may step it with any step it accepts, and go back to a saved state.",)


def coupling_note(name: str, fmi: str = "2") -> tuple[str, ...]:
    """Paragraphs on how to step an FMU with the rest of a system.

    Parameters
    ----------
    name : str
        Name of the FMU.
    fmi : {"2", "3"}
        Version of FMI.

    Examples
    --------
    >>> [len(coupling_note(name)) for name in ("stiction-mass", "another")]
    [2, 1]
    """
    return _NOTES.get(name, _ANY) + (_EARLY.get(name, ()) if fmi == "3" else ())
