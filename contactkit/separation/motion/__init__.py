"""Motion of a mass held back by a film: state, events, time steps.

state    State of a motion, and the forces that act in it.
events   Release, rupture, rest on asperities, re-wetting, pull-off and re-contact of solids.
volume   A film that loses liquid in a step: its volume at the stages.
cavity   A film with a cavity in a step: its forces, and the events that end the step.
advance  Adaptive internal steps (error control), cut at events.
sensitivity Slopes of a motion over parameters: its steps, differentiated.
"""
