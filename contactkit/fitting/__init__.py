"""Fits of scenes to measured curves: values, intervals, and what the data decide.

fit         `fit`: least squares of a scene or a device to measured curves and bounds.
data        Measured curves and bounds, with their noise and the nuisances of the instrument.
parameters  Parameters: paths and nuisances, bounds, scaling, priors.
outcomes    Columns and numbers of the run of any scene or device.
runs        Runs of a scene and their exact slopes, each made once, in worker processes if wanted.
read_off    Columns at the positions of the instrument, through a spring.
model       What the runs predict of all readings, and its exact derivatives.
search      Residuals, derivatives and the search for the minimum.
intervals   Intervals from the covariance or the profile likelihood.
verdict     What the data decide, what they do not, what the model misses, in words.
fitted      Parts of the result: parameters with intervals, curves with residuals, cost.
result      Result of a fit: values, intervals, verdicts, residuals, the fitted scene.
profile     Profile likelihood of a parameter.
posterior   Posterior, by the ensemble sampler of emcee.
compare     `compare_fits`: which of several models the data ask for.
readers     Measured curves from CSV files, data frames, datasets and results.
csv_columns Columns of CSV files.
force_curves
            Force curves of atomic force microscopes, in and out.
fit_file    Files of fits.
"""
