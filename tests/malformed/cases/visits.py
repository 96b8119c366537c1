"""Malformed files of visits: visits.md."""
import struct

from damage import Chunk, set_field, simple

# Visits. two_triangles_visits: five rays, three of which fetched the only pair
VISITS = "two_triangles_visits"
simple(2002, "visits_before_primitives", lambda f: f.chunks.insert(f.index("PRIM"), f.chunks.pop(f.index("VISI"))), VISITS)
simple(2002, "visits_of_ssh", lambda f: f.chunks.append(Chunk(b"VISI", 0, struct.pack("<2I", 5, 3))), "two_triangles_ssh")
simple(2003, "visits_twice", lambda f: f.chunks.append(Chunk(b"VISI", 0, f["VISI"].raw)), VISITS)
simple(2004, "visits_that_survive", lambda f: set_field(f["VISI"], flags=2), VISITS)
simple(2005, "visits_too_few", lambda f: f.replace("VISI", f["VISI"].raw[:-4]), VISITS)
simple(2005, "visits_too_many", lambda f: f.replace("VISI", f["VISI"].raw + bytes(4)), VISITS)
simple(2021, "visits_above_parent", lambda f: f.patch("VISI", 4, "I", 6), VISITS)
