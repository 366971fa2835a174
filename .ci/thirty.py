"""Pictures of examples from thirty cameras that stay where they are, to look at before and after a change.

    python .ci/thirty.py HSD OUT [BEFORE]

Needs the package pillow, and what `hsd render` needs. The cameras are those of grammar/pictures/thirty.json, three for each of ten
examples. OUT gets a picture of each; with BEFORE, a folder of an earlier run, also compared.jpg, in which each picture stands beside
that of before, and the mean difference of both is written, of 255.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image, ImageChops, ImageStat

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIZE = (720, 480)


def drawn(hsd, out):
    """Draws all; returns their paths."""
    cameras = json.loads((ROOT / "grammar/pictures/thirty.json").read_text())
    paths = []
    for example, views in cameras.items():
        with tempfile.TemporaryDirectory() as folder:
            asked = pathlib.Path(folder, "cameras.json")
            asked.write_text(json.dumps(views))
            source = ROOT / "examples" / f"{example}.hsd"
            words = ["--camera", asked, "--detail", "3", "--size", "x".join(map(str, SIZE))]
            subprocess.run([hsd, "render", source, "-o", f"{folder}/", *words], check=True, stdout=subprocess.DEVNULL)
            for view in views:
                (made,) = pathlib.Path(folder).glob(f"*{view['name']}.png")
                path = out / f"{example}-{view['name']}.jpg"
                Image.open(made).convert("RGB").save(path, quality=80)
                paths.append(path)
                print(path, flush=True)
    return paths


def compared(paths, before):
    """A sheet of all pairs: before on the left, after on the right."""
    half = (SIZE[0] // 2, SIZE[1] // 2)
    sheet = Image.new("RGB", (4 * half[0], (len(paths) + 1) // 2 * half[1]))
    for number, path in enumerate(paths):
        pair = [Image.open(folder / path.name) for folder in (before, path.parent)]
        apart = ImageStat.Stat(ImageChops.difference(*pair)).mean
        print(f"{path.stem}: {sum(apart) / 3:.2f}")
        for side, picture in enumerate(pair):
            place = ((number % 2 * 2 + side) * half[0], number // 2 * half[1])
            sheet.paste(picture.resize(half), place)
    sheet.save(paths[0].parent / "compared.jpg", quality=75)


def main():
    hsd, out, *before = sys.argv[1:]
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    paths = drawn(str(pathlib.Path(hsd).resolve()), out)
    if before:
        compared(paths, pathlib.Path(before[0]))


if __name__ == "__main__":
    main()
