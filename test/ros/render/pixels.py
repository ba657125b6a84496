"""What pixels of the pictures of a node say of light and of edges."""


def linear(level):
    """Of the light that is white, of a level of the display."""
    display = level / 255.0
    return ((display + 0.055) / 1.055) ** 2.4 if display > 0.04045 else display / 12.92


def pixel(image, x, y):
    return [linear(level) for level in image.data[y * image.step + 3 * x:][:3]]


def right_edge(image, row):
    """Of the red box that fills the middle of a row, px: up to where pixels are red, the last one by its share."""
    def red(x):
        r, _, b = pixel(image, x, row)
        return r - b
    middle = image.width // 2
    half = (red(middle) + red(image.width - 1)) / 2
    edge = next(x for x in range(middle, image.width) if red(x) < half)
    # What is beside the edge, since a sky is not the same all along a row.
    inside, outside = red(edge - 3), red(edge + 3)
    return edge - 2.5 + sum((red(x) - outside) / (inside - outside) for x in range(edge - 2, edge + 3))
