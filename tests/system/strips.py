"""The law per length of metal that yields, as a function of the overlap."""


def force_of_strip(law, overlap, largest, up_to):
    """Force per length at an overlap, by bisection from 0 to `up_to` [N/m].

    `law` is a function of a force per length and the largest one so far, with the overlap as the `approach` of its result.
    """
    low, high = 0.0, up_to
    if overlap <= law(1e-6, largest).approach:
        return 0.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if law(middle, largest).approach < overlap else (low, middle)
    return low
