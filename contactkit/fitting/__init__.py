"""Fits of scenes to measured curves: values, intervals, and what the data decide.

fit         `fit`: least squares of a scene or a device to measured curves and bounds.
data        Measured curves and bounds, with their noise and the nuisances of the instrument.
parameters  Parameters: paths and nuisances, bounds, scaling, priors.
outcomes    Columns and numbers of the run of any scene or device.
model       Runs read at the positions of the instrument, through a spring.
search      Residuals, derivatives and the search for the minimum.
intervals   Intervals from the covariance or the profile likelihood.
verdict     What the data decide, what they do not, what the model misses, in words.
result      Result of a fit: values, intervals, verdicts, residuals, the fitted scene.
"""
