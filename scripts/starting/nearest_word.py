"""The word of a list that a misspelled word most likely means: as lib/text/plain_text.hpp for the programs.

Near is at most a third of the word's length, in Damerau-Levenshtein distance; upper and lower case are equal. Else the
shortest that begins with the word, of four characters or more.
"""
MAX_LENGTH = 64  # longer words are not compared
MIN_BEGIN = 4    # shorter words begin too many others


def edit_distance(one, other):
    """Inserted, missing, wrong and transposed characters. Source: Lowrance, Wagner, J. ACM 22 (1975)."""
    far = len(one) + len(other)
    table = {(-1, -1): far}
    for i in range(len(one) + 1):
        table[i, -1], table[i, 0] = far, i
    for j in range(len(other) + 1):
        table[-1, j], table[0, j] = far, j
    last_row = {}
    for i in range(1, len(one) + 1):
        last_match = 0
        for j in range(1, len(other) + 1):
            row, column = last_row.get(other[j - 1], 0), last_match
            equal = one[i - 1] == other[j - 1]
            if equal:
                last_match = j
            table[i, j] = min(table[i - 1, j - 1] + (not equal), table[i, j - 1] + 1, table[i - 1, j] + 1,
                              table[row - 1, column - 1] + (i - row - 1) + 1 + (j - column - 1))
        last_row[one[i - 1]] = i
    return table[len(one), len(other)]


def did_you_mean(word, valid):
    """"did you mean 'VALID'? " with the nearest; empty when none is near enough."""
    if len(word) > MAX_LENGTH:
        return ""
    distances = [edit_distance(word.lower(), each.lower()) for each in valid]
    best = min(distances, default=MAX_LENGTH)
    if best <= len(word) // 3:
        return f"did you mean '{valid[distances.index(best)]}'? "
    completions = [each for each in valid if len(word) >= MIN_BEGIN and each.lower().startswith(word.lower())]
    return f"did you mean '{min(completions, key=len)}'? " if completions else ""
