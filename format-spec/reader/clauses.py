"""Why a file is rejected: a clause of diagnostics.md."""
UNSUPPORTED = {1003, 1004, 1014, 2001, 2008, 2010}


class Rejected(Exception):
    def __init__(self, clause, message):
        super().__init__(message)
        self.clause = clause
        self.kind = "unsupported" if clause in UNSUPPORTED else "invalid"


def reject_if(condition, clause, message):
    if condition:
        raise Rejected(clause, message)
