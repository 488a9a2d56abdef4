"""Damaged and forged archives: `verify` ends within seconds, and accepts nothing but what was archived.

archives.py BRISTLE SECONDS SEED FOLDER
"""
import hashlib
import io
import pathlib
import random
import subprocess
import sys
import tarfile

import h5py

from common import Campaign, Failure, Program, damaged

bristle, seconds, seed, folder = Program(sys.argv[1]), float(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
source = pathlib.Path(__file__).resolve().parents[2]
r = random.Random(f"archives {seed}")
SECONDS = 60  # for one command
MANIFESTS = ("manifest-sha512.txt", "tagmanifest-sha512.txt")

folder.mkdir(parents=True, exist_ok=True)
repository, victim = folder / "repository", folder / "victim.tar"
repository.mkdir()
subprocess.run([source / "tests/program/small_repository.sh", bristle.path, source], cwd=repository, check=True)
for command in (["run", "experiments/quick.json", "--quiet"], ["assumptions", "--tier", "full", "-q"]):
    bristle(*command, cwd=repository, allowed={0})
for ending in ("pdf", "png"):
    (repository / f"figures/quick.{ending}").write_bytes(h5py.File(repository / "results/quick.h5").attrs["payload_sha256"])
bristle("archive", "--allow-dirty", "-o", "whole.tar", cwd=repository, allowed={0})
whole = (repository / "whole.tar").read_bytes()


def files(data):
    """The members of an archive and their contents."""
    with tarfile.open(fileobj=io.BytesIO(data)) as tar:
        return [(member, tar.extractfile(member).read()) for member in tar.getmembers() if member.isfile()]


def packed(members):
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for member, content in members:
            member.size = len(content)
            tar.addfile(member, io.BytesIO(content))
    return out.getvalue()


def with_right_hashes(members):
    """The manifests of a forger who knows what SHA-512 is."""
    base = members[0][0].name.split("/")[0]
    for manifest in MANIFESTS:
        for i, (member, content) in enumerate(members):
            if member.name != f"{base}/{manifest}":
                continue
            inside = {m.name.removeprefix(f"{base}/"): c for m, c in members}
            names = [line.split(maxsplit=1)[-1] for line in content.decode(errors="replace").splitlines() if line.strip()]
            lines = [f"{hashlib.sha512(inside[name]).hexdigest()}  {name}" for name in names if name in inside]
            members[i] = member, ("\n".join(lines) + "\n").encode()
    return members


def forged():
    """An archive in which one file is another, absent, double or renamed. Returns what was done and the bytes."""
    members = files(whole)
    at = r.randrange(len(members))
    member, content = members[at]
    kind = r.choice(["changed", "changed", "changed", "absent", "double", "renamed", "link", "outside"])
    if kind == "changed":
        other = damaged(content, r) if content else b"x"
        if other == content:
            return None
        members[at] = member, other
    elif kind == "absent":
        del members[at]
    elif kind == "double":
        members.append((member, content))
    elif kind == "renamed":
        member.name += r.choice(["x", " ", "\n", "/x", "é"])
    elif kind == "link":
        member.type, member.linkname = r.choice([tarfile.SYMTYPE, tarfile.LNKTYPE]), r.choice(["/etc/passwd", "../../x"])
        members[at] = member, b""
    else:
        member.name = r.choice(["../outside", "/tmp/outside", f"{member.name}/../../../outside"])
    return kind, packed(with_right_hashes(members) if r.random() < 0.7 else members)


def step():
    if r.random() < 0.5:
        kind, data = "damaged", damaged(whole, r)
    else:
        change = forged()
        if not change:
            return "without a change"
        kind, data = "forged", change[1]
    if data == whole:
        return "without a change"
    victim.write_bytes(data)
    rerun = ["--rerun", "1"] if r.random() < 0.1 else []
    code, out, error = bristle("verify", victim, *rerun, seconds=SECONDS)
    if code not in (1, 2):
        kept = folder / f"accepted-{campaign.counts['FAILED']}.tar"
        kept.write_bytes(data)
        raise Failure(f"verify: exit code {code} for an archive that is {change[0] if kind == 'forged' else kind}: {kept}")
    if "\x1b" in out + error:
        raise Failure("verify shows control characters")
    return kind


campaign = Campaign("archives", seconds)
campaign.repeat(step)
print(f"slowest: {bristle.slowest[0]:.1f} s: {bristle.slowest[1]}")
sys.exit(0 if campaign.report() else 1)
