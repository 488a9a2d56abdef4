"""Reading a result file of unknown origin once, in a child process with limited time and memory.

As src/results/inspect.cpp does: libhdf5 loops, crashes or fills the memory on some damaged files.
"""

import hashlib
import os
import resource
import warnings
from functools import lru_cache

import h5py

from .errors import BristleError, is_of_the_system, system_reason

SECONDS = 5  # of processor time
BYTES_PER_SECOND = 20_000_000
MEMORY = 256 << 20  # bytes beyond the memory of this process and the size of the file
MAX_DEPTH = 4  # of groups
COPIED = "copied"
UNREAD = "unread: "  # before the system's reason


class CopiedResult(BristleError):
    """A result that another program wrote from one of bristle: its digest is the digest of the file of bristle."""


def require_intact(path):
    """Raises BristleError if the HDF5 file cannot be read, or is a result but not as `bristle run` wrote it.

    A file that was intact is read again only if it has changed since.
    """
    try:
        state = os.stat(path)
    except OSError as error:
        raise BristleError(f"{path}: cannot be read: {system_reason(error)}") from error
    require_intact_state(os.fspath(path), state.st_mtime_ns, state.st_size, state.st_ino)


@lru_cache(maxsize=256)
def require_intact_state(path, *_):
    """The same for the file in one state: the time of its last change, its size and its number in the file system."""
    try:
        receive, send = os.pipe()
    except OSError as error:
        raise BristleError(f"{path}: cannot be read: {system_reason(error)}") from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of a fork beside threads: the child uses none
        child = os.fork()
    if child == 0:
        report(path, send)
    os.close(send)
    with os.fdopen(receive, "rb") as answer:
        damage = answer.read().decode()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status != 0:
        damage = f"the process that read it ended with {status}"  # -9: beyond the limits
    if damage == COPIED:
        raise CopiedResult(f"{path}: written by another program from a result of bristle (it has no group /provenance), so "
                           f"its digest cannot be checked; draw the Dataset itself: draw(xarray.open_dataset('{path}'))")
    if damage.startswith(UNREAD):
        raise BristleError(f"{path}: cannot be read: {damage.removeprefix(UNREAD)}")
    if damage:
        raise BristleError(f"{path}: damaged, or not written by bristle: {damage}; "
                           "restore the file, or compute it again with `bristle run`")


def report(path, send):
    """Writes what is damaged to the descriptor, and ends this process."""
    status = 1
    try:
        size = os.path.getsize(path)
        limit(resource.RLIMIT_CORE, 0)
        limit(resource.RLIMIT_CPU, SECONDS + size // BYTES_PER_SECOND)
        with open("/proc/self/statm", encoding="ascii") as numbers:
            mapped = int(numbers.read().split()[0]) * resource.getpagesize()
        limit(resource.RLIMIT_AS, mapped + MEMORY + 4 * size)
        try:
            with h5py.File(path, "r") as file:
                damage = damage_of(file)
        except (OSError, RuntimeError, KeyError, ValueError, MemoryError) as error:
            damage = UNREAD + system_reason(error) if is_of_the_system(error) else f"{type(error).__name__}: {error}"
        os.write(send, damage[:1000].encode())
        status = 0
    finally:
        os._exit(status)


def limit(kind, value):
    resource.setrlimit(kind, (value, value))


def damage_of(file):
    """What is damaged; empty if the file is intact, or is no result of bristle."""
    digest = hashlib.sha256()
    read_group(file, "", 0, digest)
    if not text(file.attrs.get("schema_version", "")).startswith("bristle-"):
        return ""
    stated = {name: text(file.attrs.get(name, "")) for name in
              ("payload_sha256", "experiment_sha256", "experiment")}
    if digest.hexdigest() != stated["payload_sha256"]:
        return "payload_sha256 does not match the numbers" if "provenance" in file else COPIED
    if hashlib.sha256(stated["experiment"].encode()).hexdigest() != stated["experiment_sha256"]:
        return "experiment_sha256 does not match the experiment"
    return ""


def read_group(group, prefix, depth, digest):
    """Adds names, types, shapes, units, meanings of flags and values of the payload to the digest
    (docs/results-format.md); reads the rest."""
    if depth > MAX_DEPTH:
        raise ValueError(f"{prefix}: groups nested too deeply")
    read_attributes(group)
    for name in sorted(group, key=str.encode):
        path = prefix + name
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise ValueError(f"/{path}: a soft or external link")
        found = group[name]
        outside = digest is None or path in ("checks", "provenance")
        if isinstance(found, h5py.Group):
            read_group(found, path + "/", depth + 1, None if outside else digest)
        else:
            read_attributes(found)
            read_dataset(found, path, None if outside else digest)


def read_dataset(data, path, digest):
    if data.is_virtual or data.external:
        raise ValueError(f"/{path}: a dataset stored in another file")
    values = data[()]
    if digest is not None:
        text_data = data.dtype.kind in "OS"
        kind = "s" if text_data else f"{'f' if data.dtype.kind == 'f' else 'i'}{data.dtype.itemsize}"
        digest.update(" ".join([f"/{path} {kind}", *map(str, data.shape)]).encode() + b"\n")
        for name in [name for name in ("units", "flag_meanings") if name in data.attrs]:
            digest.update(f"{name} {text(data.attrs[name])}\n".encode())
        digest.update(b"".join(word + b"\0" for word in values) if text_data else values.tobytes())


def read_attributes(found):
    for name in found.attrs:
        found.attrs[name]


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
