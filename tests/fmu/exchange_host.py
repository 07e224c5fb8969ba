"""A host for model exchange: a mass on a spring around a film, integrated by CVode."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from fmpy import fmi2, fmi3, read_model_description
from fmpy.sundials import CVodeSolver


class Motion(NamedTuple):
    """What a run left: events, and time, gap, speed, J_m and J at accepted points."""

    points: np.ndarray
    events: list
    release_time: float
    evaluations: int


class Film:
    """An instance for model exchange, by the names of its variables, in either version of FMI."""

    def __init__(self, folder, **start):
        about = read_model_description(str(folder))
        self.variables = {v.name: v for v in about.modelVariables}
        self.is_fmi3 = about.fmiVersion.startswith("3")
        kind = fmi3.FMU3Model if self.is_fmi3 else fmi2.FMU2Model
        self.fmu = kind(
            instanceName="film",
            guid=about.guid,
            unzipDirectory=str(folder),
            modelIdentifier=about.modelExchange.modelIdentifier,
        )
        self.n_states, self.n_indicators = (
            about.numberOfContinuousStates,
            about.numberOfEventIndicators,
        )
        self.fmu.instantiate()
        self.set(**start)
        if not self.is_fmi3:
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.update()

    def _reference(self, name):
        return [self.variables[name].valueReference]

    def set(self, **values):
        setter = self.fmu.setFloat64 if self.is_fmi3 else self.fmu.setReal
        for name, value in values.items():
            setter(self._reference(name), [value])

    def get(self, name):
        kind = self.variables[name].type
        if not self.is_fmi3:
            kind = kind.replace("Enumeration", "Integer")
        else:
            kind = kind.replace("Enumeration", "Int64")
        return getattr(self.fmu, f"get{kind}")(self._reference(name))[0]

    def slope(self, of, by):
        found = self.fmu.getDirectionalDerivative(self._reference(of), self._reference(by), [1.0])
        return found[0]

    def _numbers(self, call, count):
        found = np.zeros(count)
        call(np.ctypeslib.as_ctypes(found), count)
        return found

    def states(self):
        return self._numbers(self.fmu.getContinuousStates, self.n_states)

    def set_states(self, values):
        given = np.array(values, dtype=float)
        self.fmu.setContinuousStates(np.ctypeslib.as_ctypes(given), self.n_states)

    def derivatives(self):
        name = "getContinuousStateDerivatives" if self.is_fmi3 else "getDerivatives"
        return self._numbers(getattr(self.fmu, name), self.n_states)

    def indicators(self):
        return self._numbers(self.fmu.getEventIndicators, self.n_indicators)

    def nominals(self):
        return self._numbers(self.fmu.getNominalsOfContinuousStates, self.n_states)

    def update(self):
        """Update the discrete states and go on."""
        call = self.fmu.updateDiscreteStates if self.is_fmi3 else self.fmu.newDiscreteStates
        assert tuple(call())[:5] == (False,) * 5
        self.fmu.enterContinuousTimeMode()

    def event(self):
        self.fmu.enterEventMode()
        self.update()

    def close(self):
        self.fmu.freeInstance()


class Pulled:
    """A body whose film is an FMU: its gap and speed, the states of the film, and a release.

    `acceleration` follows from time, gap and force of the film.
    """

    def __init__(self, film, acceleration, *, gap, speed=0.0, release_gap=1.0, rtol=1e-8):
        self.film, self.acceleration, self.release_gap = film, acceleration, release_gap
        self.state, self.time, self.evaluations = np.array([gap, speed, *film.states()]), 0.0, 0
        self.solver = CVodeSolver(
            nx=len(self.state),
            nz=film.n_indicators + 1,
            get_x=self._give(lambda: self.state),
            set_x=self._take,
            get_dx=self._give(self._rates),
            get_z=self._give(self._indicators),
            get_nominals=self._give(lambda: np.array([gap, 1e-3, *film.nominals()])),
            set_time=self._clock,
            input=self,
            startTime=0.0,
            relativeTolerance=rtol,
            maxNumSteps=100_000,
        )

    def apply(self, time):
        """Nothing: the motion is a state."""

    def _give(self, of):
        def give(place, count):
            np.ctypeslib.as_array(place, (count,))[:] = of()

        return give

    def _take(self, place, count):
        self.state = np.ctypeslib.as_array(place, (count,)).copy()
        self.film.set(h=self.state[0], v=self.state[1])
        self.film.set_states(self.state[2:])

    def _clock(self, time):
        self.time = time
        self.film.fmu.setTime(time)

    def _rates(self):
        self.evaluations += 1
        gap, speed, rates = self.state[0], self.state[1], self.film.derivatives()
        return np.array([speed, self.acceleration(self.time, gap, rates.sum()), *rates])

    def _indicators(self):
        return np.array([*self.film.indicators(), self.state[0] / self.release_gap - 1.0])

    def run(self, stop):
        """Integrate up to a time, or the release."""
        points, events, released = [], [], -1.0
        while self.time < stop and released < 0.0:
            event, roots, time = self.solver.step(self.time, stop)
            self._clock(time)
            points.append((time, *self.state))
            self.film.fmu.completedIntegratorStep()
            if event:
                events.append((time, [i for i, root in enumerate(roots) if root]))
                released = time if roots[-1] else -1.0
                self.film.event()
                self.solver.reset(time)
        return Motion(np.array(points), events, released, self.evaluations)
