"""gallery.py [--accept] [SCENE…]: problems/gallery.md, a picture of what each scene of problems/ comes to.

With --accept these scenes, or all, are run and drawn again into problems/gallery/, and the page is written. Without, nothing
runs: exit status 1 if the page does not show what problems/ has. It is run by scripts/gallery, which finds the package.
"""

import argparse
import io
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROBLEMS = ROOT / "problems"
PICTURES = PROBLEMS / "gallery"
WIDTH, COLOURS = 420, 96  # of a picture on the page
HEADINGS = {1: "Along a line", 2: "In the plane", 3: "In space"}
A_ROW = 3

HEAD = """# Gallery

What each scene of this folder comes to: the points at the end of the run, where they then are, by plastic strain or
displacement. `scripts/run problems/NAME.toml` runs one and leaves its report; what it computes, its equations and its source
stand at its head. Written by `scripts/gallery --accept`, which runs them all.
"""


def read(file):
    with open(file, "rb") as text:
        return tomllib.load(text)


def cell(file, scene):
    laws = sorted({material["law"] for material in scene["material"].values()})
    name = file.stem
    return f"[![{scene['title']}](gallery/{name}.png)]({file.name})<br>**{scene['title']}**<br>`{name}`, {', '.join(laws)}"


def page(scenes):
    text = HEAD
    for dim, heading in HEADINGS.items():
        cells = [cell(file, scene) for file, scene in scenes.items() if scene.get("dim", 1) == dim]
        text += f"\n## {heading}\n\n{'|   ' * A_ROW}|\n{'|---' * A_ROW}|\n"
        for k in range(0, len(cells), A_ROW):
            row = cells[k : k + A_ROW]
            text += "| " + " | ".join(row + [""] * (A_ROW - len(row))) + " |\n"
    return text


def draw(file):
    """Runs a scene and draws its end."""
    import stillpoint
    from PIL import Image

    simulation = stillpoint.Simulation(file).run()
    raw = io.BytesIO()
    simulation.plot_points().savefig(raw, dpi=150)
    picture = Image.open(raw).convert("RGB")
    small = picture.resize((WIDTH, round(WIDTH * picture.height / picture.width)), Image.Resampling.LANCZOS)
    PICTURES.mkdir(exist_ok=True)
    small.quantize(COLOURS, dither=Image.Dither.NONE).save(PICTURES / f"{file.stem}.png", optimize=True)
    print(f"{file.stem}: {simulation.status}, {len(simulation.points)} points")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("scenes", metavar="SCENE", type=Path, nargs="*")
    options = parser.parse_args()
    scenes = {file: read(file) for file in sorted(PROBLEMS.glob("*.toml"))}
    if options.accept:
        for file in options.scenes or scenes:
            draw(file.resolve())
        (PROBLEMS / "gallery.md").write_text(page(scenes), encoding="utf-8")
        return 0
    wrong = [f"{file.name}: no gallery/{file.stem}.png" for file in scenes if not (PICTURES / f"{file.stem}.png").exists()]
    wrong += [f"gallery/{p.name}: no scene" for p in PICTURES.glob("*.png") if not (PROBLEMS / f"{p.stem}.toml").exists()]
    there = (PROBLEMS / "gallery.md").read_text(encoding="utf-8") if (PROBLEMS / "gallery.md").exists() else ""
    if there != page(scenes):
        wrong.append("gallery.md is not what the scenes say; scripts/gallery --accept writes it")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
