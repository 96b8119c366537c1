"""Boxes as six numbers, and boxes given by insets from a root's."""
import math

from clauses import reject_if
from floats import float_up


def around(boxes):
    return [(min if i < 3 else max)(b[i] for b in boxes) for i in range(6)]


def inside(inner, outer):
    return all(outer[i] <= inner[i] and outer[i + 3] >= inner[i + 3] for i in range(3))


def check_root(root):
    reject_if(not all(map(math.isfinite, root)) or any(root[i] > root[i + 3] for i in range(3)), 4001, "the root's box")


def box_of(root, own):
    """The floats within the box that insets give."""
    return [float_up(root[i] + own[i]) for i in range(3)] + [-float_up(-(root[i] - own[i])) for i in range(3, 6)]


def box_within(root, frame, own):
    """What of that lies in the box of a tree's root."""
    box = box_of(frame, own)
    return [max(box[i], root[i]) if i < 3 else min(box[i], root[i]) for i in range(6)]
