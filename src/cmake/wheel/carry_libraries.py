"""carry_libraries.py FILES: takes the shared libraries that a wheel's files need, but those of every system, from this one
into FILES/stillpoint_mpm/lib, with their copyright notices. Prints the platform that the wheel is for, as pip names it.

This is what auditwheel does, which Debian does not have. A library gets a name with a hash of what it holds, so that
nobody takes it for one of the same name that the process has from elsewhere: NumPy may bring another OpenBLAS, h5py
another HDF5. Each file finds the libraries by their place relative to its own.
"""

import hashlib
import os
import platform
import re
import shutil
import sys
from pathlib import Path
from subprocess import check_output

# What PEP 600 lets a wheel expect of every system that has glibc of the version in its name.
OF_EVERY_SYSTEM = {"ld-linux-x86-64.so.2", "libc.so.6", "libm.so.6", "libgcc_s.so.1", "libstdc++.so.6"}
NO_NETWORK = "libno_network.so.0"
STAND_INS = {
    "libblas.so.3": "libopenblas.so.0",  # which has all of the two inside; Debian makes libraries of their names by it
    "liblapack.so.3": "libopenblas.so.0",
    "libcurl.so.4": NO_NETWORK,
    "libcrypto.so.3": NO_NETWORK,
}
# Debian packages of which our own files hold something, and no library tells.
COMPILED_IN = ("libcli11-dev", "libeigen3-dev", "libtomlplusplus-dev", "nlohmann-json3-dev", "pybind11-dev")


def main(files):
    beside = files / "stillpoint_mpm"
    folder = beside / "lib"
    for link in [path for path in folder.rglob("*") if path.is_symlink()]:  # a wheel has no links
        link.resolve().replace(link)
    ours = [path for path in files.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]

    sources = libraries_of(ours, folder)
    notices = [path for soname, path in sources.items() if soname != NO_NETWORK]
    names = {soname: hashed_name(soname, source) for soname, source in sources.items()}
    carried = [Path(shutil.copyfile(source, folder / names[soname])) for soname, source in sources.items()]
    names |= {soname: names[other] for soname, other in STAND_INS.items()}

    replaced = [word for pair in names.items() for word in ("--replace-needed", *pair)]
    for path in ours + carried:
        path.chmod(0o755)
        # One call each: patchelf 0.14 spoils names when it changes several kinds at once.
        check_output(["patchelf", *replaced, path])
        check_output(["patchelf", "--set-rpath", f"$ORIGIN/{os.path.relpath(folder, path.parent)}", path])
        if path in carried:
            check_output(["patchelf", "--set-soname", path.name, path])

    keep_notices(notices, beside / "copyright")
    print(f"manylinux_{glibc_of(ours + carried)}_{platform.machine()}")


def libraries_of(programs, own_folder):
    """The files of the libraries that these need and that have to be carried, by the names by which they are asked for."""
    here = {NO_NETWORK: no_network(own_folder.parent)}  # what this system's loader finds
    # OpenBLAS may be there for several kinds of threads; ours are those of OpenMP.
    first = [own_folder, *Path("/usr/lib").glob("*/openblas-openmp")]
    environment = os.environ | {"LD_LIBRARY_PATH": ":".join(map(str, first)), "LC_ALL": "C"}
    for line in check_output(["ldd", *programs], text=True, env=environment).splitlines():
        if match := re.fullmatch(r"\s+(\S+) => (/\S+) \(0x\w+\)", line):
            here[match[1]] = Path(match[2]).resolve()
    ours = {soname for soname, path in here.items() if own_folder in path.parents}

    carried = {}
    left = list(programs)
    while left:
        for soname in check_output(["patchelf", "--print-needed", left.pop()], text=True).split():
            soname = STAND_INS.get(soname, soname)
            if soname not in OF_EVERY_SYSTEM | ours | carried.keys():
                carried[soname] = here[soname]
                left.append(here[soname])
    return carried


def no_network(folder):
    source = Path(__file__).with_name("no_network.c")
    library = folder / NO_NETWORK
    check_output(["cc", "-shared", "-O2", "-fPIC", source, f"-Wl,--version-script={source.with_suffix('.map')}", "-o", library])
    return library


def hashed_name(soname, source):
    stem, dot, rest = soname.partition(".so")
    return f"{stem}-{hashlib.sha256(source.read_bytes()).hexdigest()[:8]}{dot}{rest}"


def keep_notices(libraries, folder):
    """The copyright notices of the Debian packages from which these are, and of this one."""
    folder.mkdir()
    # Debian 12 still says /lib of some files that lie in /usr/lib.
    patterns = ["*" + str(path).removeprefix("/usr") for path in libraries]
    owners = {line.split(":")[0] for line in check_output(["dpkg-query", "--search", *patterns], text=True).splitlines()}
    for owner in sorted(owners | set(COMPILED_IN)):
        shutil.copyfile(f"/usr/share/doc/{owner}/copyright", folder / owner)
    shutil.copyfile(Path(__file__).parents[1] / "packages/copyright", folder / "stillpoint")


def glibc_of(paths):
    """The oldest glibc with all symbols for which these files ask: 2_36."""
    symbols = check_output(["readelf", "--version-info", "--wide", *paths], text=True)
    return "2_%d" % max(int(minor) for minor in re.findall(r"\bGLIBC_2\.(\d+)", symbols))


main(Path(sys.argv[1]).resolve())
