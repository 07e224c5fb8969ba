"""A rough body on a coated one: pressure at the contact spots, and stress in coating and steel.

Twenty nanometres of diamond-like carbon on bearing steel carry a self-affine rough body. The grid
resolves the shortest wave, the spots and the coating, so that every number of the run is inside
its range of validity.
"""

from __future__ import annotations

import sys
from pathlib import Path

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import MPa, nm, um


def main(out: Path) -> float:
    """Draw pressure and stress; return how many ranges of validity the run leaves [-]."""
    carbon, steel = ck.load_material("dlc"), ck.load_material("bearing-steel")
    coated = ck.Stack(layers=(ck.Layer(material=carbon, thickness=20 * nm),), substrate=steel)
    rough = ck.SelfAffineRoughness(rms=2 * nm, hurst=0.8, rolloff=1 * um, cutoff=80 * nm, seed=1)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=coated), upper=ck.Body(surface=rough)),
        window=ck.Window(width=3 * um),
        loading=ck.Pressing(pressure=200 * MPa),
        effects=(ck.LayeredHalfSpace(), ck.HardnessLimit(), ck.SubsurfaceStress(keep="planes")),
    )
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=384)))
    figure, (left, right) = plot.figure(1, 2, size=(10.4, 3.7), width_ratios=(1.0, 1.4))
    result.plot.pressure(ax=left)
    plot.title(left, f"{100.0 * result.contact_fraction:.2g} % of the window is in contact")
    result.plot.stress(ax=right)
    right.set(xlim=(-165.0, 165.0), anchor="N")  # [nm]
    plot.save(figure, out / "rough_coating")
    return float(sum("OUT OF RANGE" in str(one) for one in result.validity))


if __name__ == "__main__":
    sys.stdout.write(f"ranges of validity left: {main(Path('out/examples')):.0f}\n")
