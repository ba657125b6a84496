"""What is shown of more than a page can hold."""

SHOWN_PAIRS = 12
SHOWN_CONDITIONS = 6  # side by side


def evenly_spread(items, count):
    """`count` of them in their order, first and last included."""
    if len(items) <= count:
        return list(items)
    return [items[round(k * (len(items) - 1) / (count - 1))] for k in range(count)]


def shown_pairs(pairs, references):
    """All of few; of more some that have one of `references`, as the map, or else some of all."""
    if len(pairs) <= SHOWN_PAIRS:
        return list(pairs)
    related = [pair for pair in pairs if any(one in references for one in pair)]
    return evenly_spread(related or pairs, SHOWN_PAIRS)
