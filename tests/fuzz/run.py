"""Read changed files for as long as is asked: python tests/fuzz/run.py --minutes 60.

The only outcomes allowed are an object that is as it should be, and a ContactkitError. All others,
and whatever takes longer than some seconds or leaves a file behind, is kept in a folder.
"""

from __future__ import annotations

import argparse
import faulthandler
import hashlib
import random
import resource
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parent))

from fuzz_readers import Reader, readers
from mutations import changed

from contactkit.errors import ContactkitError

LONGEST = 5.0  # [s] of a processor that a file may take
MOST_MEMORY = 4 * 2**30  # [bytes], so that what takes more fails here and not elsewhere


class Finding(NamedTuple):
    """A file that was not read as it should be."""

    reader: str
    name: str
    content: bytes
    what: str


class TooLongError(BaseException):
    """Reading takes too long; no reader catches this."""


def one(name: str, reader: Reader, file: str, content: bytes) -> str | Finding:
    """Read one file; what came of it in a word, or the finding."""
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        path = Path(folder) / file
        path.write_bytes(content)
        started = time.process_time()
        outcome = "read"
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found: Any = reader.read(path)
                reader.check(found)
        except ContactkitError as error:
            outcome = "refused"
            if not str(error) or len(str(error)) > 20_000:
                return Finding(name, file, content, f"a message of {len(str(error))} letters")
        except (Exception, TooLongError):  # noqa: BLE001 that is what is looked for
            return Finding(name, file, content, traceback.format_exc())
        seconds = time.process_time() - started
        if seconds > LONGEST:
            return Finding(name, file, content, f"took {seconds:.1f} s of a processor")
        left = [one.name for one in Path(folder).iterdir() if one.name != file]
        if left or path.read_bytes() != content:
            return Finding(name, file, content, f"left {left}, or changed the file")
    return outcome


def cases(name: str, reader: Reader, seed: int, n: int, keep: Path | None = None) -> list[Finding]:
    """Findings among `n` changed files of a reader; equal seeds give equal files.

    The file that is being read is kept in a folder, so that one that ends the process is there.
    """
    found = []
    for i in range(n):
        dice = random.Random(f"{name} {seed} {i}")
        file = dice.choice(sorted(reader.seeds))
        content = changed(reader.seeds[file], list(reader.seeds.values()), dice)
        if keep is not None:
            (keep / f"last--{name}--{file}").write_bytes(content)
        outcome = one(name, reader, file, content)
        if isinstance(outcome, Finding):
            found.append(outcome)
    return found


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def _too_long(*_: Any) -> None:
    raise TooLongError


def main() -> int:
    """Run for some minutes; the exit status is 1 if there is a finding."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--only", nargs="*", help="readers, such as scene result map fmu")
    parser.add_argument("--out", type=Path, default=Path("out/fuzz"))
    parser.add_argument("--again", type=Path, help="a file of a finding, to read again")
    given = parser.parse_args()
    known = readers()
    if given.again is not None:
        name, _, file = given.again.name.partition("--")[2].partition("--")
        outcome = one(name, known[name](), file, given.again.read_bytes())
        _say(outcome.what if isinstance(outcome, Finding) else outcome)
        return 0
    made = {name: known[name]() for name in given.only or known}
    faulthandler.enable()
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    signal.signal(signal.SIGALRM, _too_long)
    _say(f"seed {given.seed}, readers {', '.join(made)}")
    return 1 if _searched(made, given.seed, 60.0 * given.minutes, given.out) else 0


def _searched(made: dict[str, Reader], seed: int, seconds: float, out: Path) -> Counter[str]:
    end, said, i = time.monotonic() + seconds, time.monotonic(), 0
    out.mkdir(parents=True, exist_ok=True)
    counts, kept = Counter[str](), Counter[str]()
    while time.monotonic() < end:
        name = list(made)[i % len(made)]
        signal.alarm(120)  # of a busy machine; `one` judges by the time of the processor
        found = cases(name, made[name], seed + i, 10, out)
        signal.alarm(0)
        counts[name] += 10
        i += 1
        for finding in found:
            _keep(finding, kept, out)
        if time.monotonic() > said + 60.0:
            said = time.monotonic()
            _report(counts, kept)
    _report(counts, kept)
    return kept


def _keep(finding: Finding, kept: Counter[str], out: Path) -> None:
    last = finding.what.strip().splitlines()
    kind = f"{finding.reader}: {last[-1][:150]}"
    kept[kind] += 1
    if kept[kind] <= 2:
        out.mkdir(parents=True, exist_ok=True)
        digest = hashlib.sha256(finding.content).hexdigest()[:12]
        path = out / f"{digest}--{finding.reader}--{finding.name}"
        path.write_bytes(finding.content)
        _say(f"{path}\n{finding.what}")


def _report(counts: Counter[str], kept: Counter[str]) -> None:
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    _say(f"{dict(counts)} files, {memory:.0f} MiB, findings {dict(kept)}")


if __name__ == "__main__":
    sys.exit(main())
