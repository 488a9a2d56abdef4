"""The version of the Python package is that of the program, which CMakeLists.txt states; the rest is in pyproject.toml."""

import re

from setuptools import setup

with open("CMakeLists.txt", encoding="utf-8") as file:
    setup(version=re.search(r"^set\(BRISTLE_VERSION ([^ )]+)", file.read(), re.M)[1])
