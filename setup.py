# SPDX-License-Identifier: Apache-2.0
"""pip's way to the Python module: CMake builds the library, the program and the extension module in build/python."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

sources = Path(__file__).resolve().parent
version = re.search(r"project\(hogel VERSION ([0-9.]+)", (sources / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    """Options of CMake may stand in CMAKE_ARGS, and how many files are compiled at once in CMAKE_BUILD_PARALLEL_LEVEL.
    HOGEL_BUILD names a folder in which CMake has built all with HOGEL_PYTHON=ON; it is then taken as it is."""

    def build_extension(self, extension):
        build = Path(os.environ.get("HOGEL_BUILD") or sources / "build" / "python")
        if "HOGEL_BUILD" not in os.environ:
            self.compile(build)
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        for folder, pattern in ("lib", "libhogel.so.[0-9]"), ("bin", "hogel"):
            (package / folder).mkdir(parents=True, exist_ok=True)
            for file in (build / folder).glob(pattern):
                shutil.copy(file, package / folder / file.name)
        for pattern in "_core.*.so", "_core.pyi":
            for file in (build / "python" / "hogel").glob(pattern):
                shutil.copy(file, package / file.name)

    def compile(self, build):
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DHOGEL_PYTHON=ON", "-DHOGEL_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        if shutil.which("ninja"):
            options += ["-G", "Ninja"]
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        options += os.environ.get("CMAKE_ARGS", "").split()
        subprocess.run(["cmake", "-S", sources, "-B", build, *options], check=True)
        parallel = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(len(os.sched_getaffinity(0)))
        subprocess.run(["cmake", "--build", build, "--parallel", parallel, "--target", "hogel", "hogel_cli", "_core"], check=True)


setup(
    version=version,
    packages=["hogel"],
    package_dir={"": "python"},
    package_data={"hogel": ["py.typed"]},
    ext_modules=[Extension("hogel._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
