"""Reference solutions of studies, hard cases and tests, computed by other means: files of JSON.

tables  Content of the files of reference solutions.

releases.json  Release times by two other codes that agree to 1e-9.
layered.json   Compliances and stresses of layered half-spaces, of 60 digits.
contact.json   Spheres on layered solids, and waves of one direction in partial contact.
"""
