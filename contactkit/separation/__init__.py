"""Separation and sliding of wetted surfaces: plan, simulate, result.

effects        Forces, limits and ends of the film that a scene may list.
any_plan       Plan by the engine that the effects ask for: rigid or deforming bodies.
plan           Plan of a separation: the checked scene, its liquid, and each effect prepared once.
bodies         Checks of the two bodies: rigid, flats or spheres, with room for the film.
face           Film on a face that is no disc: damping law, and cavity on a grid.
rheology       Film of a liquid whose viscosity depends on pressure and shear, or that slips.
cavity         Cavity of a film that is pulled apart, with the history of its rupture.
film           Sum of the prepared forces, and the limits of the liquid.
simulate       Run of a plan: curve of a speed, impulse of a time, or motion under a pull.
first_closing  Bodies that close before a rising pull opens them.
prescribed     Separations at an imposed speed, or within an imposed time.
vibration      Separation at an imposed speed with a vibration of the gap.
cavity_points  Film that cavitates, along an imposed motion.
motion_curves  Curves of a motion, computed when asked for.
refine         Points between the steps of a motion where straight lines need them.
bridge_end     Distance of a bridge to its end, which lines of curves follow.
motion         Motion of a mass under a pull: state, events, time steps.
integrator     Implicit integration of a mass on a stiff film.
curve_result   Base class of the results of a separation and of a sliding.
results        Result of a separation: curves, numbers, ranges of validity, and cost.
columns        Curves of the motion and of the state of the film.
scales         Reference scales: capillary force, viscous impulse, time.
validity       Numbers of validity along a run.
deforming      Separation of bodies that deform while a film is between them.
sliding        One wetted surface sliding past another.
wetting        Dynamic wetting: weight, deposited film, moving angle, column, rupture.
"""
