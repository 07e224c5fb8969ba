"""Everything a host should not do to an FMU, done to it: `python probe.py SPEC.json`.

Prints what was found as one JSON object by the names of the cases; `test_probe_fmus.py` judges it.
The name of a case goes to standard error before it runs, so that a crash has an address.
"""

from __future__ import annotations

import json
import math
import random
import sys
import threading
from pathlib import Path

from probe_calls import DISCARD, ERROR, FATAL, OK, Instance, Library, Reference, c

CASES = []
WILD = (math.nan, math.inf, -math.inf)
STRANGE = (0, 2**32 - 1)
PHASES = ("instantiated", "initialization", "stepping", "terminated")


def case(function):
    CASES.append(function)
    return function


class Lab:
    """An FMU with its variables and the run it must be able to do again, whatever was done."""

    def __init__(self, spec: dict) -> None:
        self.spec, self.library = spec, Library(spec)
        self.variables = spec["variables"]
        self.steps = spec["steps"]
        self.middle = len(self.steps) // 2
        self.reference = self.run(self.bring(self.open()))

    def of(self, *causalities, kind=None):
        chosen = [v for v in self.variables if v["causality"] in causalities]
        return [v for v in chosen if kind is None or v["kind"] == kind]

    def open(self, **changes) -> Instance:
        instance = self.library.open(**changes)
        assert instance, "no instance"
        return instance

    def put(self, instance, values: dict) -> list[int]:
        by_name = {v["name"]: v for v in self.variables}
        return [
            instance.set(by_name[name]["kind"], [by_name[name]["reference"]], [value])
            for name, value in values.items()
        ]

    def bring(self, instance, phase="stepping"):
        """Bring a new or a reset instance to a phase of its life."""
        instance.setup()
        self.put(instance, self.spec["start"])
        if phase != "instantiated":
            instance.enter()
        if phase in ("stepping", "terminated"):
            instance.exit()
        if phase == "terminated":
            instance.terminate()
        return instance

    def outputs(self, instance) -> list:
        """Every output, as text that holds all its bits."""
        found = []
        for v in self.of("output"):
            _, values = instance.get(v["kind"], [v["reference"]])
            found.append(values[0].hex() if isinstance(values[0], float) else int(values[0]))
        return found

    def run(self, instance, first=0, last=None, time=None) -> list:
        """Steps of the reference run and the outputs after each."""
        found, time = [], sum(h for h, _ in self.steps[:first]) if time is None else time
        for length, inputs in self.steps[first:last]:
            self.put(instance, inputs)
            status = instance.step(time, length)
            time += length
            found.append([status, *self.outputs(instance)])
        return found

    def again(self, instance, steps=None) -> bool:
        """Whether a reset makes the instance as good as new."""
        done = instance.reset() == OK
        return done and self.run(self.bring(instance), 0, steps) == self.reference[:steps]

    def finite(self, instance) -> bool:
        reals = [v["reference"] for v in self.variables if v["kind"] == "real"]
        return all(math.isfinite(x) for x in instance.get("real", reals)[1])


def go_on(lab, instance, phase) -> list[int]:
    """What a host that heard nothing would do next: on to stepping, and a step."""
    found = []
    if phase == "instantiated":
        found.append(instance.enter())
    if phase in ("instantiated", "initialization"):
        found.append(instance.exit())
    time = getattr(instance, "now", 0.0)
    return [*found, instance.step(time, lab.steps[0][0])]


def trouble(lab, act, phase="stepping"):
    """Do something wrong in a phase, and tell what came of it."""
    instance = lab.bring(lab.open(), phase)
    instance.statuses.clear(), instance.log.clear()
    act(instance)
    go_on(lab, instance, phase)
    statuses = [status for _, status in instance.statuses]
    found = {
        "worst": max(statuses),
        "finite": lab.finite(instance),
        "errors": [e for e in instance.log if e[0] in (DISCARD, ERROR)],
        "fatal": [name for name, status in instance.statuses if status >= FATAL],
    }
    found["again"] = lab.again(instance, 1)
    instance.free()
    return found


def each(found: dict) -> dict:
    """Many troubles as one case."""
    return {"troubles": found}


@case
def reference(lab):
    names = [v["name"] for v in lab.of("output")]
    return {
        "fine": all(row[0] == OK for row in lab.reference),
        "moves": len({json.dumps(row[1:]) for row in lab.reference}) > 1,
        "breaks": any(
            row[1 + names.index("n_break")] > 0 for row in lab.reference if "n_break" in names
        ),
    }


@case
def illegal_references(lab):
    found = {}
    real = {v["reference"]: v["kind"] for v in lab.variables}
    some = next(iter(real))
    for kind, value in (("real", 1.0), ("integer", 1), ("boolean", True), ("string", b"x")):
        own = next((r for r, k in real.items() if k == kind), some)
        for odd in STRANGE if kind in ("real", "integer") else STRANGE[:1]:
            found[f"get {kind} {odd}"] = trouble(lab, lambda i, k=kind, o=odd: i.get(k, [o]))
            found[f"set {kind} {odd}"] = trouble(
                lab, lambda i, k=kind, o=odd, v=value: i.set(k, [o], [v])
            )
        wrong = next(r for r, k in real.items() if k != kind and k != "enumeration")
        found[f"get {kind} of another type"] = trouble(
            lab, lambda i, k=kind, w=wrong, o=own: i.get(k, [o, w])
        )
    return each(found)


@case
def wild_inputs(lab):
    found = {}
    for v in lab.of("input", kind="real"):
        for value in WILD:
            act = lambda i, v=v, x=value: i.set("real", [v["reference"]], [x])  # noqa: E731
            found[f"{v['name']} = {value}"] = trouble(lab, act)
    for v in lab.of("parameter", kind="real"):
        act = lambda i, v=v: i.set("real", [v["reference"]], [math.nan])  # noqa: E731
        found[f"{v['name']} = nan"] = trouble(lab, act, "initialization")
    for v in [*lab.of("input", "parameter", kind="enumeration")]:
        act = lambda i, v=v: i.set("enumeration", [v["reference"]], [99])  # noqa: E731
        found[f"{v['name']} = 99"] = trouble(lab, act, "initialization")
    return each(found)


@case
def huge_inputs(lab):
    """Numbers that are none of the host's business to send, but are numbers."""
    found = {}
    for v in lab.of("input", kind="real"):
        for value in (1e308, -1e30, 5e-324):
            act = lambda i, v=v, x=value: i.set("real", [v["reference"]], [x])  # noqa: E731
            found[f"{v['name']} = {value}"] = trouble(lab, act)
    return {"survived": found}


@case
def set_in_the_wrong_state(lab):
    found = {}
    for causality, phases in (("parameter", PHASES[2:]), ("output", PHASES), ("input", PHASES[3:])):
        v = next(iter(lab.of(causality, kind="real")), None)
        for phase in phases if v else ():
            act = lambda i, v=v: i.set("real", [v["reference"]], [v["start"]])  # noqa: E731
            found[f"{causality} {v['name']} while {phase}"] = trouble(lab, act, phase)
    return each(found)


@case
def calls_out_of_turn(lab):
    h = lab.steps[0][0]
    wrong = {
        "instantiated": {"exit": Instance.exit, "step": lambda i: i.step(0.0, h)},
        "initialization": {"enter": Instance.enter, "step": lambda i: i.step(0.0, h)},
        "stepping": {"enter": Instance.enter, "exit": Instance.exit},
        "terminated": {
            "enter": Instance.enter,
            "exit": Instance.exit,
            "step": lambda i: i.step(0.0, h),
        },
    }
    return each(
        {
            f"{name} while {phase}": trouble(lab, act, phase)
            for phase, calls in wrong.items()
            for name, act in calls.items()
        }
    )


@case
def twice(lab):
    """The whole initialization twice over, and the end twice."""

    def initialize(i):
        i.setup(), i.enter(), i.exit()

    instance = lab.bring(lab.open())
    ends = [instance.terminate(), instance.terminate()]
    finite = lab.finite(instance)
    return each({"initialization": trouble(lab, initialize)}) | {
        "ends": ends,
        "finite": finite,
        "again": lab.again(instance),
    }


@case
def bad_steps(lab):
    h = lab.steps[0][0]

    def back(i):
        i.step(0.0, h)
        i.step(0.0, h)

    odd = {
        "back in time": back,
        "ahead": lambda i: i.step(3.0 * h, h),
        "backwards": lambda i: i.step(0.0, -h),
    }
    for value in WILD:
        odd[f"of {value}"] = lambda i, x=value: i.step(0.0, x)
        odd[f"at {value}"] = lambda i, x=value: i.step(x, h)
    return each({name: trouble(lab, act) for name, act in odd.items()})


@case
def steps_of_nothing(lab):
    """A step of zero or of rounding size is fine and changes nothing."""
    instance = lab.bring(lab.open())
    found = lab.run(instance, 0, lab.middle)
    time = sum(h for h, _ in lab.steps[: lab.middle])
    before = lab.outputs(instance)
    statuses = [instance.step(time, x) for x in (0.0, -0.0, 1e-14 * time, -1e-14 * time)]
    same = before == lab.outputs(instance)
    found += lab.run(instance, lab.middle)
    instance.free()
    return {"statuses": statuses, "same": same and found == lab.reference}


@case
def huge_steps(lab):
    """A step beyond all sense may be refused, but must end and give numbers."""
    found = {}
    for value in (1e300, 1e6, 1e-300):
        found[f"of {value}"] = trouble(lab, lambda i, x=value: i.step(0.0, x))
    return {"survived": found}


@case
def reset_in_every_phase(lab):
    found = {}
    for phase in PHASES:
        instance = lab.bring(lab.open(), phase)
        if phase == "stepping":
            lab.run(instance, 0, lab.middle)
        found[phase] = lab.again(instance) and lab.again(instance)
        instance.free()
    return {"again": all(found.values()), "where": found}


@case
def get_before_initialization(lab):
    """Values of all variables in every phase are numbers."""
    found = {}
    for phase in PHASES:
        instance = lab.bring(lab.open(), phase)
        found[phase] = lab.finite(instance)
        instance.free()
    return {"finite": all(found.values()), "where": found}


@case
def twenty_instances(lab):
    """Side by side, a step each in turn; those freed do not disturb the others."""
    many = [lab.bring(lab.open(name=b"one of many")) for _ in range(20)]
    rows = [[] for _ in many]
    time = 0.0
    for k, (length, _) in enumerate(lab.steps):
        if k == lab.middle:
            for instance in many[10:]:
                instance.free()
            del many[10:]
        for instance, row in zip(many, rows, strict=False):
            row += lab.run(instance, k, k + 1, time)
        time += length
    for instance in many:
        instance.free()
    return {"same": all(row == lab.reference for row in rows[:10])}


@case
def threads(lab):
    """Eight instances, each in a thread of its own from the first call to the last."""
    found, rooms = {}, [lab.open(name=b"own thread") for _ in range(4)]

    def work(k):
        instance = rooms[k] if k < 4 else lab.open(name=b"own thread")
        found[k] = lab.run(lab.bring(instance)) == lab.reference and lab.again(instance)
        instance.free()

    running = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in running:
        thread.start()
    for thread in running:
        thread.join()
    return {"same": len(found) == 8 and all(found.values())}


@case
def states_across_the_run(lab):
    """Taken in the middle, before the rupture; restored after it, here and elsewhere."""
    instance, other, third = (lab.bring(lab.open()) for _ in range(3))
    begin = lab.run(instance, 0, lab.middle)
    status, state = instance.take()
    _, content = instance.write(state)
    rest = lab.run(instance, lab.middle)
    back = instance.restore(state)
    found = {"statuses": [status, back], "size": len(content)}
    found["same"] = lab.run(instance, lab.middle) == rest and begin + rest == lab.reference
    _, strange = other.read(content)
    found["statuses"] += [other.restore(strange)]
    found["elsewhere"] = lab.run(other, lab.middle) == rest
    found["statuses"] += [instance.terminate(), instance.restore(state)]
    found["after the end"] = lab.run(instance, lab.middle) == rest
    found["statuses"] += [third.restore(state)]
    found["of another"] = lab.run(third, lab.middle) == rest
    found["statuses"] += [other.drop(strange), instance.drop(state)]
    for one in (instance, other, third):
        one.free()
    return found


@case
def spoilt_states(lab):
    """Bytes that are no state, cut or changed anywhere."""
    instance = lab.bring(lab.open())
    lab.run(instance, 0, lab.middle)
    _, state = instance.take()
    _, content = instance.write(state)
    instance.drop(state)
    instance.free()
    chance, found = random.Random(5), {}
    spoilt = {"empty": b"", "short": content[:-3], "long": b"x" + content, "noise": b"\0\xff" * 99}
    for k in range(4):
        place = chance.randrange(len(content))
        flipped = bytes([content[place] ^ 1 << chance.randrange(7)])
        spoilt[f"bit {k}"] = content[:place] + flipped + content[place + 1 :]

    def take_in(i, bytes_):
        status, odd = i.read(bytes_)
        if status == OK:
            i.restore(odd)
            i.drop(odd)

    for name, one in spoilt.items():
        found[name] = trouble(lab, lambda i, b=one: take_in(i, b))
    bits = {name: found.pop(name) for name in list(found) if name.startswith("bit")}
    return each(found) | {"survived": bits}  # a digit of a number may be another legal number


def no_instance(lab):
    """What cannot be instantiated, and with which words."""
    odd = {
        "wrong GUID": {"guid": b"{00000000-0000-0000-0000-000000000000}"},
        "no such folder": {"resources": lab.library.resources.encode() + b"/none"},
        "wrong kind": {"kind": 0},
    }
    found = {}
    for name, changes in odd.items():
        instance = Instance(lab.library, **changes)
        found[name] = {"none": not instance.pointer, "errors": [e for e in instance.log if e[0]]}
        if instance.pointer:
            instance.free()
    one = lab.open()
    found["again"] = lab.run(lab.bring(one)) == lab.reference
    one.free()
    return found


@case
def silence(lab):
    """A host that wants no logging hears why it is refused, and nothing else."""
    instance = lab.bring(lab.open(logging=False))
    v = lab.of("input", kind="real")[0]
    instance.set("real", [v["reference"]], [math.nan])
    worst = max(instance.step(0.0, lab.steps[0][0]), instance.statuses[-2][1])
    said = list(instance.log)
    found = {"said": said, "worst": worst, "again": lab.again(instance)}
    instance.free()
    return found


@case
def anything(lab):
    """Calls in no order at all, with values of no sense."""
    chance = random.Random(11)
    references = [v["reference"] for v in lab.variables] + list(STRANGE)
    numbers = [*WILD, 0.0, 1.0, -1.0, 1e-6, 1e-3, 1e308, lab.steps[0][0]]
    fatal, finite, states = [], True, []
    instance = lab.open()
    for _ in range(30):
        lab.bring(instance, chance.choice(PHASES))
        for _ in range(10):
            act = chance.randrange(9)
            number, reference = chance.choice(numbers), chance.choice(references)
            if act == 0:
                instance.set("real", [reference], [number])
            elif act == 1:
                instance.get(chance.choice(["real", "integer", "boolean"]), [reference])
            elif act == 2:
                instance.set("integer", [reference], [chance.randrange(-5, 99)])
            elif act == 3:
                instance.step(chance.choice([0.0, number]), chance.choice([number, 1e-6]))
            elif act == 4:
                chance.choice([Instance.enter, Instance.exit, Instance.terminate])(instance)
            elif act == 5:
                states.append(instance.take()[1])
            elif act == 6 and states:
                instance.restore(chance.choice(states))
            elif act == 7 and states:
                instance.read(instance.write(chance.choice(states))[1])
            else:
                instance.setup(number)
        finite = finite and lab.finite(instance)
        instance.reset()
    fatal = [name for name, status in instance.statuses if status >= FATAL]
    for state in states:
        instance.drop(state)
    found = {"fatal": fatal, "finite": finite, "again": lab.again(instance)}
    instance.free()
    return found


# what asks more of an FMU than pythonfmu's C++ can bear ---------------------------------------


def freed_twice(lab):
    instance = lab.bring(lab.open())
    instance.free()
    instance.free()
    return {}


def used_after_free(lab):
    instance = lab.bring(lab.open())
    instance.free()
    return {"statuses": [instance.step(0.0, 1e-6), instance.reset(), instance.get("real", [1])[0]]}


def no_instance_at_all(lab):
    instance = lab.open()
    instance.pointer = None
    statuses = [instance.step(0.0, 1e-6), instance.reset(), instance.get("real", [1])[0]]
    instance.free()
    return {"statuses": statuses}


def foreign_pointer(lab):
    instance, room = lab.open(), c.create_string_buffer(256)
    instance.pointer = c.addressof(room)
    statuses = [instance.step(0.0, 1e-6), instance.reset(), instance.get("real", [1])[0]]
    instance.free()
    return {"statuses": statuses}


def null_arguments(lab):
    instance = lab.bring(lab.open())
    size = () if instance.version == 2 else (c.c_size_t(3),)
    name = "Real" if instance.version == 2 else "Float64"
    some = (Reference * 3)(1, 2, 3)
    statuses = [
        instance.call(f"{verb}{name}", refs, c.c_size_t(3), None, *size)
        for verb in ("Get", "Set")
        for refs in (None, some)
    ]
    again = lab.again(instance)
    instance.free()
    return {"statuses": statuses, "again": again}


def null_states(lab):
    instance = lab.bring(lab.open())
    none = c.c_void_p()
    statuses = [
        instance.restore(none),
        instance.write(none)[0],
        instance.call(instance._state("GetFMUstate"), None),
        instance.call(instance._state("DeSerializeFMUstate"), None, c.c_size_t(9), None),
    ]
    again = lab.again(instance)
    instance.free()
    return {"statuses": statuses, "again": again}


def state_freed_twice(lab):
    instance = lab.bring(lab.open())
    _, state = instance.take()
    copies = [c.c_void_p(state.value) for _ in range(3)]
    first = instance.drop(copies[0])
    statuses = [instance.drop(copies[1]), instance.restore(copies[2])]
    again = lab.again(instance)
    instance.free()
    return {"statuses": statuses, "first": first, "again": again}


def state_in_place_of_its_address(lab):
    """`fmi2FreeFMUstate(c, state)`, as hosts write it that leave out the `&`."""
    instance = lab.bring(lab.open())
    _, state = instance.take()
    spare = c.c_void_p(state.value)
    freed = [instance.call(instance._state("FreeFMUstate"), state) for _ in range(2)]
    content = c.create_string_buffer(b"x" * 99)
    statuses = [
        instance.restore(spare),
        instance.call(instance._state("GetFMUstate"), spare),
        instance.call(instance._state("DeSerializeFMUstate"), content, c.c_size_t(99), spare),
    ]
    again = lab.again(instance)
    instance.free()
    return {"freed": freed, "statuses": statuses, "again": again}


def nameless(lab):
    found = [Instance(lab.library, **{key: None}).pointer for key in ("name", "guid", "resources")]
    return {"none": [not pointer for pointer in found]}


def odd_path(lab):
    """A resource location as hosts write it, with percent signs for letters beyond ASCII."""
    spec = lab.spec["odd folder"]
    location = (Path(spec) / "resources").as_uri().encode()
    if lab.library.version == 3:
        location = f"{spec}/resources/".encode()
    instance = lab.library.open(resources=location)
    same = instance is not None and lab.run(lab.bring(instance)) == lab.reference
    return {"same": same}


def deaf(lab):
    """No function to log with, although logging is on."""
    instance = lab.bring(lab.open(silent=True))
    instance.step(0.0, math.nan)
    again = lab.again(instance)
    instance.free()
    return {"again": again}


def wrong_counts(lab):
    """FMI 3 says how many values there are; here it is not as many as the references."""
    instance = lab.bring(lab.open())
    values = (c.c_double * 4)()
    statuses = (
        [
            instance.call(
                f"{verb}Float64", (Reference * 3)(1, 2, 3), c.c_size_t(3), values, c.c_size_t(n)
            )
            for verb in ("Get", "Set")
            for n in (0, 2, 4)
        ]
        if instance.version == 3
        else [ERROR]
    )
    again = lab.again(instance)
    instance.free()
    return {"statuses": statuses, "again": again}


HARD = [
    no_instance,
    freed_twice,
    used_after_free,
    no_instance_at_all,
    foreign_pointer,
    null_arguments,
    null_states,
    state_freed_twice,
    state_in_place_of_its_address,
    nameless,
    odd_path,
    deaf,
    wrong_counts,
]


def main() -> None:
    """Run the cases named, or all but the hard ones."""
    spec = json.loads(Path(sys.argv[1]).read_text())
    chosen = sys.argv[2:]
    if spec.get("together"):
        sys.stdout.write(json.dumps(together(spec["together"])))
        return
    lab, found = Lab(spec), {}
    for one in CASES + HARD:
        if one.__name__ in chosen or (not chosen and one in CASES):
            sys.stderr.write(f"{one.__name__}\n")
            sys.stderr.flush()
            found[one.__name__] = one(lab)
    sys.stdout.write(json.dumps(found))


def together(specs) -> dict:
    """Several FMUs in this one process: each does what it does alone, a step at a time in turn."""
    labs = [Lab(spec) for spec in specs]
    open_ = [(lab, lab.bring(lab.open())) for lab in labs for _ in range(2)]
    rows, most = [[] for _ in open_], max(len(lab.steps) for lab in labs)
    for k in range(most):
        for (lab, instance), row in zip(open_, rows, strict=True):
            row += lab.run(instance, k, k + 1)
    return {
        "same": [row == lab.reference for (lab, _), row in zip(open_, rows, strict=True)],
        "discarded": [row[0] == DISCARD for lab in labs for row in lab.reference],
    }


if __name__ == "__main__":
    main()
