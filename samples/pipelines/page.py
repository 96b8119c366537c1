"""Pages whose head is written by hand, and whose tables by a script."""
import os


def write_after_marker(path, marker, text):
    """Replaces what follows the marker in a page that has it, and else the whole file. Without a path it prints."""
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
