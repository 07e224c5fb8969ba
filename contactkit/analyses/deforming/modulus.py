"""Storage and loss modulus of a film between deforming bodies over the frequency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from attrs import field, frozen

from ...accuracy import Accuracy
from ...arguments import positive_values
from ...errors import PlanError
from ...lubrication.elastohydrodynamic import response
from ...lubrication.elastohydrodynamic.mesh import RingMesh, disc_nodes, graded_nodes
from ...lubrication.elastohydrodynamic.motion import SmoothGap
from ...scene.curve import Curve, Shown
from ...scene.plan import check_scene
from ...scene.scenes import SeparationScene
from ...separation.deforming.plan import plan_deforming
from ...units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["ModulusCurve", "modulus_curve"]

# Of the finest of three meshes, per e-fold of the radius beyond the width of the pressure: 1e-4 of
# the loss modulus, tests/analyses/test_deforming_analyses.py.
_ELEMENTS = 30
_FLAT_ELEMENTS = 80


@frozen(eq=False)
class ModulusCurve(Curve):
    """Moduli of a film between deforming bodies; arrays of one shape.

    Attributes
    ----------
    frequency : ndarray, shape (n,)
        [Hz]
    storage_modulus, loss_modulus : ndarray, shape (n,)
        G' and G'' [N/m]: the force in phase with the motion, and that in phase with its rate.
    stiff_storage, stiff_loss : ndarray, shape (n,)
        Their limits for bodies that hardly deform [N/m]; of layers those of the topmost material.
    gap_over_crossover : ndarray, shape (n,)
        D/D_c [-]; nan of a flat.
    modulus_error : ndarray, shape (n,)
        Error of both [N/m], by three meshes.
    """

    axis: ClassVar[str] = "frequency"
    shown: ClassVar[Shown] = {
        "moduli": (("storage_modulus", "loss_modulus", "stiff_storage", "stiff_loss"), "")
    }
    title: ClassVar[str] = "storage and loss modulus"

    frequency: Floats = field(repr=False, metadata=si("Hz"))
    storage_modulus: Floats = field(repr=False, metadata=si("N/m"))
    loss_modulus: Floats = field(repr=False, metadata=si("N/m"))
    stiff_storage: Floats = field(repr=False, metadata=si("N/m"))
    stiff_loss: Floats = field(repr=False, metadata=si("N/m"))
    gap_over_crossover: Floats = field(repr=False, metadata=si("-"))
    modulus_error: Floats = field(repr=False, metadata=si("N/m"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("Leroy and Charlaix 2011: cut-off gap of the elastohydrodynamic response",)


def modulus_curve(
    scene: SeparationScene,
    frequencies: Sequence[float | str] | Floats,
    accuracy: Accuracy | None = None,
) -> ModulusCurve:
    r"""Storage and loss modulus of a flooded film over the frequency, at `initial_gap`.

    Parameters
    ----------
    scene : SeparationScene
        With `ElasticBodies` and a flooded film; its opening is not looked at but for the gap.
    frequencies : sequence of float
        [Hz]
    accuracy : Accuracy, optional
        As of `ck.plan`.

    Raises
    ------
    PlanError
        If the bodies do not deform, or the film is not flooded.
    DescriptionError
        If a frequency is not positive.

    Notes
    -----
    Small amplitudes: full film, no cavities, no contact. A hundred frequencies take 0.2 s of CPU.

    Examples
    --------
    Below the cut-off gap the bodies take up the motion: the phase falls towards 30 degrees.

    >>> import contactkit as ck
    >>> gel = ck.Material(young_modulus=6e6, poisson_ratio=0.5)
    >>> oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    >>> body = ck.Interface(
    ...     lower=ck.Body(solid=gel), upper=ck.Sphere(radius=5e-3), meniscus=oil)
    >>> loading = ck.ImposedSpeed(speed=1e-6, initial_gap=1e-6, final_gap=3e-6)
    >>> effects = (ck.ElasticBodies(), ck.ViscousForce())
    >>> scene = ck.SeparationScene(interface=body, loading=loading, effects=effects)
    >>> curve = modulus_curve(scene, [1e-2, 1.0, 1e3])
    >>> np.degrees(np.arctan2(curve.loss_modulus, curve.storage_modulus)).round().tolist()
    [90.0, 84.0, 30.0]
    """
    check_scene(scene, SeparationScene)
    made = plan_deforming(scene, accuracy)
    film = made.film
    if not isinstance(film, SmoothGap):
        raise PlanError(
            "modulus_curve takes smooth round bodies, whose film is solved on rings: give a Flat "
            "without outline and relief, a Sphere or a Paraboloid"
        )
    if film.wetting is not None:
        raise PlanError(
            "modulus_curve needs a flooded film: the rim of a meniscus moves; leave "
            "interface.meniscus without volume and pressure, and MeniscusForce out"
        )
    given = positive_values("modulus_curve(frequencies)", frequencies, "Hz")
    rates = math.tau * given
    found = response.extrapolated(*(_moduli(film, n, rates) for n in _meshes(film)))
    is_flat = math.isinf(film.radius)
    limit = response.flat_stiff_limit if is_flat else response.sphere_stiff_limit
    size = film.rim if is_flat else film.radius
    args = size, film.gap, made.modulus, film.viscosity
    stiff = np.array([limit(*args, float(omega)) for omega in rates]).T
    crossover = np.array(
        [
            math.nan
            if is_flat
            else film.gap
            / response.sphere_crossover_gap(size, made.modulus, film.viscosity, float(omega))
            for omega in rates
        ]
    )
    return ModulusCurve(
        given, found.storage, found.loss, stiff[0], stiff[1], crossover, found.error
    )


def _meshes(film: SmoothGap) -> tuple[int, int, int]:
    finest = _FLAT_ELEMENTS
    if math.isfinite(film.radius):
        finest = _ELEMENTS * math.ceil(max(math.asinh(film.rim / film.width), 2.0))
    quarter = math.ceil(finest / 4)
    return quarter, 2 * quarter, 4 * quarter


def _moduli(film: SmoothGap, elements: int, rates: Floats) -> NDArray[np.complex128]:
    if math.isinf(film.radius):
        nodes = disc_nodes(elements, film.rim)
    else:
        nodes = graded_nodes(elements, film.rim, film.width)
    gap = film.gap + nodes**2 / (2.0 * film.radius)
    matrix = film.compliance(nodes)
    return response.modulus(RingMesh(nodes), gap, matrix, film.viscosity, rates.tolist())
