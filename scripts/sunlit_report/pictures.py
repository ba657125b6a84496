"""The picture grid like the paper's Fig. 1: five poses, each under every condition."""

import base64
import io

from PIL import Image  # matplotlib needs it as well

from . import names
from .choice import SHOWN_CONDITIONS, evenly_spread
from .csv_rows import ReportError

POSES = 5
LARGEST_WIDTH = 640  # px on the page
GRID_WIDTH = 1920  # px of all columns together
QUALITY = 88


def data_uri(kind, content):
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def svg_uri(text):
    return data_uri("image/svg+xml", text.encode())


def picture_of(path, mode):
    """Whole, in a mode of Pillow."""
    try:
        with Image.open(path) as image:
            return image.convert(mode)
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:  # SyntaxError: damaged parts of PNG
        raise ReportError(f"{path}: cannot be read as a picture: {error}") from None


def embedded(file, largest_width=LARGEST_WIDTH):
    """A picture file, as JPEG within the page."""
    picture = picture_of(file, "RGB")
    if picture.width > largest_width:
        height = round(picture.height * largest_width / picture.width)
        picture = picture.resize((largest_width, height), Image.LANCZOS)
    content = io.BytesIO()
    picture.save(content, "JPEG", quality=QUALITY, subsampling=0)
    return data_uri("image/jpeg", content.getvalue())


def grid(output):
    """Columns (captions) and rows (pose, pictures by column); None where no pose has a picture of two conditions."""
    kept = [name for name in output.conditions if output.images.get(name)]
    if not kept:
        return None
    conditions = evenly_spread(kept, SHOWN_CONDITIONS)
    common = sorted(set.intersection(*(set(output.images[name]) for name in conditions)))
    if not common:
        return None
    poses = evenly_spread(common, POSES)
    width = min(LARGEST_WIDTH, GRID_WIDTH // len(conditions))
    return {
        "of": len(kept),
        "columns": [names.condition(name) for name in conditions],
        "rows": [(pose, [embedded(output.images[name][pose], width) for name in conditions]) for pose in poses],
    }
