"""Figures of a contact, ``result.plot``, and of its plan, ``plan.plot``."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Literal

import numpy as np

from ...analyses.subsurface import MeasureName
from ...contact.plan import ContactPlan
from ...contact.result import ContactResult
from ...errors import PlanError
from .. import contact as of_contact
from .. import maps, plastic_history, slip, stress, view3d, viscoelastic
from ..explore import Explorer, explore
from ..roughness import heights_map
from ..style import Axes, figure
from .base import Figures, of_absent_effects, registered_figures

if TYPE_CHECKING:
    from pyvista import Plotter

__all__ = ["ContactFigures", "ContactPlanFigures"]


@registered_figures.register(ContactResult)
class ContactFigures(Figures[ContactResult]):
    """Figures of a contact; those of an effect are there where the scene lists it."""

    def _hidden(self) -> frozenset[str]:
        return of_absent_effects(self._owner.plan)

    def pictures(self) -> dict[str, Callable[[], Axes]]:
        """See `Figures.pictures`; also the maps of effects that have no figures of their own.

        A map that is zero everywhere, such as the overlap of a contact that stays elastic, shows
        nothing.
        """
        result = self._owner
        kinds = [kind for kind in result.parts if not kind.figures]
        own = {one.name for kind in kinds for one in kind.arrays if one.unit != "-"}
        known = result.contents().quantities
        shown = sorted(
            name for name in own & set(maps.map_names(result)) if np.any(known[name].values)
        )
        return super().pictures() | {name: partial(self.map, name) for name in shown}

    def pressure(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the pressure; white where there is neither contact nor attraction."""
        return of_contact.pressure(self._owner, ax)

    def pressure_close_up(self, *, ax: Axes | None = None) -> Axes:
        """Draw the pressure around its maximum, a quarter of the window."""
        return of_contact.pressure_close_up(self._owner, ax)

    def gap(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the gap."""
        return maps.value_map(self._owner, "gap", ax)

    def displacement(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the normal displacement of both surfaces."""
        return maps.value_map(self._owner, "displacement", ax)

    def heights(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the heights of both bodies."""
        return maps.value_map(self._owner, "heights", ax)

    def map(self, name: str, *, ax: Axes | None = None, at: tuple[int, ...] = ()) -> Axes:
        """Draw a map by its name, also one that an effect adds; see `plot.maps.value_map`."""
        return maps.value_map(self._owner, name, ax, at)

    def areas(self, *, ax: Axes | None = None) -> Axes:
        """Draw the areas in contact, at the hardness, and wetted."""
        return of_contact.contact_spots(self._owner, ax)

    def section(self, *, row: int | None = None, ax: Axes | None = None) -> Axes:
        """Draw a section through the interface along a row; see `plot.contact.section`."""
        return of_contact.section(self._owner, ax, row=row)

    def stress(
        self,
        measure: MeasureName = "von_mises",
        *,
        depth: float | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Draw contours of the stress below the surface; see `plot.stress.below`."""
        return stress.below(self._owner, measure, ax, depth=depth)

    def stress_close_up(
        self, measure: MeasureName = "von_mises", *, ax: Axes | None = None
    ) -> Axes:
        """Draw contours of the stress in the upper fifth of the depth of `stress`: its layers."""
        depth = 0.2 * stress.depth_shown(self._owner)
        return stress.below(self._owner, measure, ax, depth=depth)

    def surface_3d(
        self, colour: str = "pressure", shape: view3d.Shape = "gap", *, off_screen: bool = False
    ) -> Plotter:
        """Draw the surface in three dimensions (extra view3d); see `plot.view3d.view_surface`."""
        return view3d.view_surface(self._owner, colour, shape, off_screen=off_screen)

    def stress_3d(self, measure: MeasureName = "von_mises", *, off_screen: bool = False) -> Plotter:
        """Draw the stress below in three dimensions, cut open; see `plot.view3d.view_stress`."""
        return view3d.view_stress(self._owner, measure, off_screen=off_screen)

    def explore(self, name: str = "pressure", measure: MeasureName | None = None) -> Explorer:
        """Look at a map or at planes of stress with the mouse; see `plot.explore.explore`."""
        return explore(self._owner, name, measure)

    def slip_zones(self, *, step: int = -1, ax: Axes | None = None) -> Axes:
        """Draw where the contact sticks and slips at the end of a step."""
        return slip.slip_zones(self._owner, ax, step)

    def traction(self, *, row: int | None = None, ax: Axes | None = None) -> Axes:
        """Draw the traction along a row at the end of each step."""
        return slip.traction_profile(self._owner, ax, row)

    def hysteresis(self, *, ax: Axes | None = None) -> Axes:
        """Draw the tangential force over the displacement."""
        return slip.hysteresis(self._owner, ax)

    def force_approach(self, *, ax: Axes | None = None) -> Axes:
        """Draw the load over the approach of a loading history."""
        return plastic_history.force_approach(self._owner, ax)

    def residual_depth(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the residual depth."""
        return plastic_history.residual_depth(self._owner, ax)

    def time_curves(self, *, ax: Axes | None = None) -> Axes:
        """Draw load, approach and contact area of a viscoelastic contact over time."""
        return viscoelastic.time_curves(self._owner, ax)

    def load_loop(self, *, ax: Axes | None = None) -> Axes:
        """Draw the load of a viscoelastic contact over its approach."""
        return viscoelastic.load_loop(self._owner, ax)


@registered_figures.register(ContactPlan)
class ContactPlanFigures(Figures[ContactPlan]):
    """Figures of a contact before it is solved."""

    def _hidden(self) -> frozenset[str]:
        interface = self._owner.scene.interface
        bodies = {"stack": interface.lower, "upper_stack": interface.upper}
        return frozenset(name for name, body in bodies.items() if body.stack is None)

    def heights(self, *, ax: Axes | None = None) -> Axes:
        """Draw the map of the heights of both bodies."""
        return heights_map(self._owner.heights, self._owner.grid.pixel_size, ax)

    def stack(self, *, ax: Axes | None = None) -> Axes:
        """Draw the layers of the lower body, not to scale.

        Raises
        ------
        PlanError
            If the body is rigid.
        """
        return self._section("lower", ax)

    def upper_stack(self, *, ax: Axes | None = None) -> Axes:
        """Draw the layers of the upper body, not to scale.

        Raises
        ------
        PlanError
            If the body is rigid.
        """
        return self._section("upper", ax)

    def _section(self, body: Literal["lower", "upper"], ax: Axes | None) -> Axes:
        stack = getattr(self._owner.scene.interface, body).stack
        if stack is None:
            raise PlanError(f"the {body} body is rigid: give interface.{body}.solid, a Stack")
        if ax is None:
            ax = figure(size=(6.0, 0.9 * len(stack.materials) + 0.6))[1]
        return of_contact.stack_section(stack, ax, f"{body} body (not to scale)")
