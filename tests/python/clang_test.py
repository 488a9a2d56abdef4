"""clang takes the sources that g++ has built: the two differ in what they know of C++20.

clang_test.py BUILD: reads each source of the program once more, without making code. Exits with 77 (skipped) without clang++.
"""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

build = pathlib.Path(sys.argv[1]).absolute()


def check(command):
    """What clang says of a command of the build, of which it keeps definitions, standard, processor and places of headers."""
    words, kept, text = iter(shlex.split(command["command"])), [], ""
    for word in words:
        if word == "-include":  # what the build has precompiled for g++
            text += f'#include "{next(words)}"\n'
        elif word == "-isystem":
            kept += [word, next(words)]
        elif word.startswith(("-I", "-D", "-std=", "-m")):
            kept.append(word)
    text += f'#include "{command["file"]}"\n'
    done = subprocess.run(["clang++", "-fsyntax-only", "-Wno-everything", *kept, "-x", "c++", "-"], input=text, cwd=build,
                          capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


if not shutil.which("clang++"):
    print("skipped: clang++ is not installed")
    sys.exit(77)
database = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True).stdout
commands = [one for one in json.loads(database) if one["output"].startswith("CMakeFiles/") and one["file"].endswith((".cpp", ".cxx"))]
assert commands, "the build compiles no file"
with ThreadPoolExecutor(os.cpu_count()) as pool:
    complaints = [said for said in pool.map(check, commands) if said]
print("\n".join(complaints) or f"{len(commands)} files")
sys.exit(bool(complaints))
