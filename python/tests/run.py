"""Runs the tests of the package, and prints their number as Alcotest does, for scripts/tally."""

import os
import sys
import unittest

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def main():
    sys.path.insert(0, HERE)
    sys.dont_write_bytecode = True
    names = [f"tests.{name}" for name in sys.argv[1:]]
    loader = unittest.defaultTestLoader
    suite = loader.loadTestsFromNames(names) if names else loader.discover("tests", top_level_dir=HERE)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=1).run(suite)
    bad = len(result.failures) + len(result.errors)
    for test, why in result.skipped:
        print(f"skipped: {test}: {why}")
    if bad:
        print(f"{bad} failure{'' if bad == 1 else 's'}! in all. {result.testsRun} tests run.")
    else:
        print(f"Test Successful in all. {result.testsRun} tests run.")
    return 1 if bad else 0


if __name__ == "__main__":
    if os.environ.get("DOLPHIN"):
        os.environ["DOLPHIN"] = os.path.abspath(os.environ["DOLPHIN"])
    os.chdir(HERE)
    sys.exit(main())
