"""What the parts of the stress campaign share: running the program within bounds, and counting what came of it."""
import collections
import pathlib
import resource
import subprocess
import time

MEMORY = 8 << 30  # bytes of address space
ALLOWED = {0, 1, 2, 3}  # exit codes


class Failure(Exception):
    """The program did something that it must not do."""


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


class Program:
    def __init__(self, path):
        self.path = str(pathlib.Path(path).resolve())
        self.slowest = (0, "")

    def __call__(self, *arguments, seconds=60, allowed=ALLOWED, cwd=None):
        """Runs the program; returns exit code, standard output and standard error. Fails for a signal, another exit
        code, no end within the time, or an error without a message."""
        words = [self.path, *map(str, arguments)]
        shown = " ".join(["bristle", *map(str, arguments)])
        begin = time.monotonic()
        try:
            done = subprocess.run(words, capture_output=True, timeout=seconds, preexec_fn=limit_memory, cwd=cwd)
        except subprocess.TimeoutExpired:
            raise Failure(f"{shown}: no end within {seconds} s") from None
        took = time.monotonic() - begin
        self.slowest = max(self.slowest, (took, shown))
        out, error = done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
        if done.returncode not in allowed:
            raise Failure(f"{shown}: exit code {done.returncode}: {error.strip()[-300:]}")
        if done.returncode in (2, 3) and not error.strip():
            raise Failure(f"{shown}: exit code {done.returncode} without a message")
        return done.returncode, out, error


class Campaign:
    """Repeats a step until the time is used up, and keeps counts and failures."""

    def __init__(self, name, seconds):
        self.name, self.seconds = name, seconds
        self.counts, self.failures = collections.Counter(), []

    def repeat(self, step):
        begin = time.monotonic()
        while time.monotonic() - begin < self.seconds:
            try:
                self.counts[step()] += 1
            except Failure as failure:
                self.counts["FAILED"] += 1
                self.failures.append(str(failure))

    def report(self):
        print(f"{self.name}: " + ", ".join(f"{n} {what}" for what, n in sorted(self.counts.items())))
        for failure in self.failures[:20]:
            print("FAILED:", failure)
        return not self.failures


def damaged(data, r):
    """A copy, drawn from r, with a few random changes of the kind that disks, networks and editors make."""
    data = bytearray(data)
    for _ in range(r.choice([1, 1, 1, 2, 5, 20])):
        at, size = r.randrange(len(data)), r.choice([1, 1, 2, 4, 8, 256, 4096])
        end = min(len(data), at + size)
        kind = r.choice(["random", "zero", "ones", "bit", "swap", "copy", "cut", "insert"])
        if kind == "random":
            data[at:end] = r.randbytes(end - at)
        elif kind == "zero":
            data[at:end] = bytes(end - at)
        elif kind == "ones":
            data[at:end] = b"\xff" * (end - at)
        elif kind == "bit":
            data[at] ^= 1 << r.randrange(8)
        elif kind in ("swap", "copy"):
            other = r.randrange(len(data) - (end - at) + 1)
            block = data[other:other + end - at]
            if kind == "swap":
                data[other:other + end - at] = data[at:end]
            data[at:end] = block
        elif kind == "cut":
            del data[at if r.random() < 0.3 else max(at, len(data) - size):]
        else:
            data[at:at] = r.randbytes(size)
        if not data:
            data = bytearray(b"\0")
    return bytes(data)
