"""Tests of the built wheel outside the repository: ``nox`` runs all, ``nox -s wheel-3.12`` one."""

import tempfile
from pathlib import Path

import nox

ROOT = Path(__file__).parent
QUICK = ("tests/app", "tests/capillary", "tests/contact", "tests/elasticity", "tests/separation")
OLDEST = (
    "array-api-compat==1.11",
    "array-api-strict==2.3",
    "attrs==24.2.0",  # of fmpy; without it 23.2.0 will do
    "cattrs==23.2.1",
    "click==8.1.0",
    "numpy==2.1.3",  # of fmpy; 2.0.0 without it
    "scipy==1.13.0",
    "tomli-w==1.0.0",
    "tqdm==4.66.0",
    "distributed==2024.1.0",
    "fmpy==0.3.28",
    "matplotlib==3.9.0",
    "numba==0.61.0",  # the first for this numpy
    "pandas==2.2.3",
    "pythonfmu==0.7.0",
    "xarray==2024.6.0",
)


def _test(session: nox.Session, *pins: str) -> None:
    """Install the wheel, and run copies of the tests where no source is found."""
    dist = session.create_tmp()
    session.install("build")
    session.run("python", "-m", "build", "--wheel", "--outdir", dist, str(ROOT))
    (wheel,) = Path(dist).glob("*.whl")
    session.install(f"{wheel}[test]", *pins)
    with tempfile.TemporaryDirectory() as folder:
        for name in ("tests", "pyproject.toml", "examples", "docs"):
            session.run("cp", "-r", str(ROOT / name), folder, external=True)
        with session.chdir(folder):
            session.run("python", "-m", "pytest", *(session.posargs or QUICK))


@nox.session(python=["3.11", "3.12", "3.13"])
def wheel(session: nox.Session) -> None:
    """Newest packages within the ranges."""
    _test(session)


@nox.session(python="3.11")
def oldest(session: nox.Session) -> None:
    """Oldest packages within the ranges."""
    _test(session, *OLDEST)
