"""Errata of the equations with a number, one sentence each, for warnings and documentation."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

__all__ = ["ERRATA"]

ERRATA: Mapping[str, str] = MappingProxyType(
    {
        "zero wavenumber": "The mean displacement of a periodic window is arbitrary, and is the "
        "datum of the displacement that is compared with 0.3 h1; and 8 x 8 Gaussian points miss "
        "the singularity of the coefficient: 8.5 % less than its mean over the cell.",
        "2.41a": "The fit holds from depth zero; the hardness of the layer up to 0.3 h is another "
        "rule, and the two together jump at 0.3 h: -12 % for H1 = 2 H2, +6 % for H1 = H2/2, at "
        "equal moduli.",
        "2.41b": "Criteria (2) and (3) compare the displacement with 0.3 h2, without h1: for "
        "h1 >= h2, as in all the cases shown, (2) never holds, and beyond 0.3 h1 the top layer has "
        "no effect.",
        "2.42": "exp(-2.3) is a tenth: beta* is the length to 10 %, the decay length is beta*/2.3. "
        "Of nearest images in a window the spectrum is negative for beta* above a fifth of it. "
        "The slope diverges without a shortest wavelength.",
        "2.43": "It is the Laplace pressure times the area: the surface tension along the rims and "
        "their curvature are left out, and the force does not add to the load.",
        "3.3": "Its logarithm is natural, and its radius comes out negative for undersaturated "
        "vapour while Eqs. (3.4)-(3.6) need it positive.",
        "3.5": "It drops the curvature around the axis (twice the right force for 90/90 deg), and "
        "the film height is r1 (cos theta1 + cos theta2), not the Kelvin radius times that.",
        "3.7": "It holds at a fixed film height, hence fixed humidity; at constant volume the "
        "factor is 1 - D / sqrt(D^2 + V / (pi R)).",
        "3.10": "Its pressure is the drop below ambient, against the sign of Eq. (3.2); and as in "
        "Table 4.1 the Laplace force of vanishing volume is added to the surface tension at a "
        "filling angle: 2 % too much at 1 deg, 27 % at 10 deg (60/60 deg).",
        "3.11": "It drops the curvature around the axis (+9 % at x/h = 10, +58 % at x/h = 1 for "
        "60/60 deg, +100 % for 90/90 deg) and yields different forces on the two bodies.",
        "3.12": "The two curvatures of a neck have opposite signs: the plus should be a minus. "
        "The printed force is 29 to 46 % too large for the source's own case and diverges where "
        "the neck closes, and at unlike angles before, where x_c = r1.",
        "3.14": "Splitting a rough surface further than n = R / (2 (s - D)) makes the menisci of "
        "neighbouring asperities overlap.",
        "3.18": "Its minus sign makes resistance negative, against Eqs. (3.22) and (3.26).",
        "3.19": "It is the impulse over the separation time, not a force at rupture, and keeps the "
        "radius constant: at constant volume it is half as large, and its printed sign is "
        "negative. x_n0 is the contact circle of the arc, as in Eq. (3.11): an upright disc of the "
        "same volume has 0.7 % less force at 60/60 deg, 4.4 % less at 0/60, 4.6 % more at "
        "180/120 (x_n0 = 50 h0).",
        "3.21": "Its sign is opposite to that of Eq. (3.16): suction is negative on opening.",
        "3.23": "It takes the rim of the film for cylindrical, and its H(x^2) should read H^2(x); "
        "the volume of revolution of the arc differs by 2 % for a film of 2 nm.",
        "3.25": "It is an impulse over the separation time; a force at a given gap would need "
        "that gap as upper limit, and would still be an average.",
        "3.26": "It is the impulse over the separation time, not a force at rupture, and the D "
        "in its denominator is the gap D_s at rupture. Its H_0 is the height s_0 of the arc: "
        "from the volume of the arc by Eq. (3.23) it would be 0.6 %, and the force 1.7 %, too "
        "small for a film of 2 nm.",
        "3.27": "It is not the limit of Eq. (3.26), which is ln((D0 + H0)^2 / (4 D0 H0)): it is "
        "zero at H0 = 2 D0, negative below and 41 to 55 % too large for H0 = 3 to 6 D0.",
        "3.33": "It inherits the errors of Eq. (3.11), which grow with the number of menisci "
        "(+42 % at 1e4 for 6 nm), and gives numbers where no bridge is stable any more.",
        "3.34": "It is the impulse over the separation time at constant radius: at constant volume "
        "it is half as large, and its printed sign is negative.",
        "3.35": "Its right side should be the force of the undivided meniscus, and it holds only "
        "where the line tension dominates.",
        "3.37": "A paraboloid replaces the sphere, an error of 3 to 14 % of the force at contact "
        "for volumes above 1e-2 R^3.",
        "3.39": "Its absolute slope loses the sign of contact angles above 90 deg.",
        "3.40": "Conserved is the volume of revolution, not the area between the axes.",
        "3.41": "It is needed only for an unsigned arc radius, and neither it nor Eq. (3.39) "
        "holds for one angle below and one above 90 deg.",
        "zero neck": "A closed neck of the arc is no criterion for rupture: the exact bridge "
        "breaks at a gap 1.4 to 15 times smaller, unless an angle is 180 deg.",
        "3.42": "It does not remove the initial gap, is infinite for theta1 + theta2 = 180 deg "
        "and turns repulsion positive.",
        "3.43": "With Eq. (3.19) as printed it tends to -1; at constant volume to 1/2.",
        "3.44": "Its right side lacks the speed: the shear stress is eta v / h0.",
        "3.51": "Its D should read L, the offset of the two circles.",
        "3.53": "It is the impulse over the separation time, not a force at rupture: the drag has "
        "its maximum at the start, 3 pi / 4 times as large, and falls with the overlap. Its radius "
        "is the contact circle x_n0 of the arc, as in Eq. (3.19): an upright disc of the same "
        "volume has 3.3 % less drag at 0/60 degrees and 3.4 % more at 180/120 (x_n0 = 50 h0).",
        "3.55": "A paraboloid replaces the sphere: the circle is 15 % too wide at s - D = R/2, "
        "41 % at R, and grows on beyond.",
        "3.56": "It takes the film thickness for that at the rim everywhere: 1 - D/s instead of "
        "ln(s/D), which is correct for shear alone and diverges for a closed gap.",
        "3.59": "N (R / sqrt(N))^(3/2) is N^(1/4), not N^(-1/2): at a given separation time the "
        "force rises with the number of asperities, at a given speed as N^(1/2).",
        "3.61": "It holds at a given separation time, for travels that shrink with the menisci; at "
        "a given speed the number of menisci has no effect.",
        "A.1": "It is J2, not the stress of von Mises, sqrt(3 J2). The figures show sqrt(J2), "
        "which is smaller by sqrt(3); its limit is the yield stress in pure shear.",
        "A.2": "It is the maximum principal stress of the plane x-y, and that of the tensor only "
        "where sigma_xz and sigma_yz vanish, as on a free surface.",
    }
)
"""Errata by equation number."""
