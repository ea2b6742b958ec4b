# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests have passed before: of each a record under a hash of all that it reads, in
${XDG_CACHE_HOME:-~/.cache}/insitu/tests. scripts/test writes them and, with --known, believes them.

A unit test reads its program, and what the machine offers: packages, the shared data beside the
project. An end-to-end test reads every program besides, and every file of the project that no program
is compiled from.
"""
import concurrent.futures
import functools
import hashlib
import json
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
FOLDER = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "insitu/tests")
SHARED = os.environ.get("INSITU_SHARED") or os.path.join(os.path.dirname(ROOT), "shared")
COMPILED = (".cc", ".h")
UNREAD = {"CHANGELOG.md"}


def digest(*parts):
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


@functools.cache
def digest_of_file(path):
    try:
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return "none"


def digest_of_files(paths):
    with concurrent.futures.ThreadPoolExecutor() as pool:
        return digest(*zip(paths, pool.map(digest_of_file, paths)))


@functools.cache
def machine():
    packages = subprocess.run(["dpkg-query", "--show"], stdout=subprocess.PIPE, text=True, check=True).stdout
    shared = []
    for folder, _, names in os.walk(SHARED):
        for name in names:
            status = os.lstat(os.path.join(folder, name))
            shared.append((folder, name, status.st_size, status.st_mtime_ns))
    return digest(packages, sorted(shared), os.environ.get("CI", ""))


@functools.cache
def project(build):
    """Every program of ours that is installed, and every file that none is compiled from, committed or not."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            stdout=subprocess.PIPE, text=True, check=True).stdout
    files = [os.path.join(ROOT, name) for name in sorted(set(listed.split("\0")) - {""} - UNREAD)
             if not name.endswith(COMPILED)]
    programs = [os.path.join(build, "bin", name) for name in sorted(os.listdir(os.path.join(build, "bin")))
                if name.startswith("insitu")]  # not benchmarks, which no test runs
    return digest(digest_of_files(files), digest_of_files(programs))


def keys_of(build, tests):
    """The record's name of each test; `tests`: of each its command."""
    keys = {}
    for test, command in tests.items():
        read = [digest_of_files([part for part in command if os.path.isfile(part)]), machine(), os.path.basename(build)]
        if test.startswith("end_to_end/"):
            tools = [os.path.join(build, "tests", name) for name in ("compare_images", "write_photograph")]
            read += [project(build), digest_of_files(tools)]
        keys[test] = digest(test, read)
    return keys


def record_of(key):
    """The count that was kept; None: nothing is known."""
    try:
        with open(os.path.join(FOLDER, key), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def keep(key, record):
    """Of a test that passed whole: what was skipped may be there next time."""
    os.makedirs(FOLDER, exist_ok=True)
    path = os.path.join(FOLDER, key)
    with open(f"{path}.{os.getpid()}", "w", encoding="utf-8") as file:
        json.dump(record, file)
    os.replace(f"{path}.{os.getpid()}", path)
