"""Writes pages whose head is written by hand and whose tables are written by a script."""
import importlib.util
import os
import sys


def write_after_marker(path, marker, text):
    """Replaces the text after the marker in a page that has it, and else the whole file. Prints the text if there is no path."""
    if not path:
        print(text, end="")
        return
    head = ""
    if os.path.exists(path):
        with open(path) as file:
            before, found, _ = file.read().partition(marker)
            head = before + found + "\n\n" if found else ""
    with open(path, "w") as file:
        file.write(head + text)


def require_matplotlib():
    """Ends the script with one line if it cannot draw: before it measures for minutes."""
    if importlib.util.find_spec("matplotlib") is None:
        sys.exit(f"{os.path.basename(sys.argv[0])}: --plot needs matplotlib: install it with 'samples/setup.sh plots', or leave --plot out")
