"""How many rays fetched each pair of nodes: visits.md."""
from clauses import reject_if


def check_visits(visits, nodes):
    """Returns how many rays there were."""
    for index, node in enumerate(nodes):
        first, count = node[6:8]
        reject_if(index != 1 and count == 0 and visits[first // 2] > visits[index // 2], 2021, f"visits of pair {first}")
    return visits[0]
