#!/usr/bin/python3
"""report_test.py ROOT CLAIM PROGRAM: one claim about report.html, as headless Chromium shows it without a network."""

import json
import re
import sys
import time
from pathlib import Path

from claims import ROOT, call, check_the_claim, claim
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

STILLPOINT = Path(sys.argv[3]).parent / "stillpoint"
SHORT_SLOPE = ("grid.cells=[60, 33]", "stop.time=4", "output.stages=[0, 2, 4]")
MEGABYTE = 1e6


def report_of(folder, command, scene, *settings, status=0):
    """The path of the report that a command leaves."""
    words = [word for setting in settings for word in ("--set", setting)]
    scene = scene if isinstance(scene, Path) else ROOT / f"problems/{scene}.toml"
    result = call(STILLPOINT, command, scene, *words, "--out", folder, "--quiet")
    assert result.returncode == status, result
    return folder / "report.html"


class Browser:
    """Chromium with one page open at a time; what the page logs is an error."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--force-device-scale-factor=1"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.execute_cdp_cmd("Network.enable", {})
        offline = {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
        self.driver.execute_cdp_cmd("Network.emulateNetworkConditions", offline)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def open(self, report, width=1200):
        metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        self.driver.get(report.as_uri())
        drawn = self.run("return document.documentElement.dataset.drawn")
        assert drawn is not None, f"{report} was not drawn: {self.log()}"
        print(f"{report.parent.name}: drawn after {drawn} ms, {report.stat().st_size / MEGABYTE:.2f} MB")
        return self

    def log(self):
        return self.driver.get_log("browser")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector="main"):
        return self.find(selector).text

    def pixels(self, selector="canvas.picture"):
        """Of each canvas, how many pixels are neither clear nor white."""
        return self.run(
            """return [...document.querySelectorAll(arguments[0])].map((canvas) => {
                 const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
                 let drawn = 0;
                 for (let k = 0; k < data.length; k += 4) drawn += data[k + 3] > 0 && data[k] + data[k + 1] + data[k + 2] < 765;
                 return drawn; });""",
            selector,
        )

    def picture(self):
        return self.run("return document.querySelector('canvas.picture').toDataURL()")

    def curves(self):
        """Of each plot, how many pixels its curves have."""
        return self.pixels(".plot canvas:first-of-type")


def until(holds):
    end = time.monotonic() + 5
    while not holds():
        assert time.monotonic() < end, "it does not come about"
        time.sleep(0.02)


def reports(folder):
    """A report of every kind."""
    return [
        report_of(folder / "bar", "run", "bar"),
        report_of(folder / "slope", "run", "slope", *SHORT_SLOPE),
        report_of(folder / "cube", "run", "oedometer"),
        report_of(folder / "compare", "compare", "bar"),
        report_of(folder / "converge", "converge", "mms_bar", "grid.basis=quadratic"),
    ]


@claim("a report of any kind is drawn without a network and without a word on the console, in a wide and a narrow window")
def _(folder):
    with Browser() as browser:
        for report in reports(folder):
            assert not re.search(r"(src|href)=\"?(https?:|//|\w+\.(js|css))", report.read_text().split('id="data"')[0]), report
            for width in (1200, 360):
                browser.open(report, width)
                assert browser.log() == [], browser.log()
                curves = browser.curves()
                assert curves and all(count > 100 for count in curves), (report, width, curves)
                assert all(count > 2000 for count in browser.pixels()), (report, width)
                overflow = browser.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
                assert overflow == 0, (report, width, overflow)
                assert browser.run("return document.documentElement.lang") == "en"


@claim("the report of the paper's slope, with its four stages, is no larger than 3 MB")
def _(folder):
    report = report_of(folder / "slope", "run", "slope", "stop.time=0.4", "output.stages=[0, 0.1, 0.2, 0.4]")
    assert report.stat().st_size < 3 * MEGABYTE, report.stat().st_size
    with Browser() as browser:
        browser.open(report)
        assert browser.find("input[type=range]").get_attribute("max") == "3"
        assert "material points are drawn" not in browser.text()  # all of them are


@claim("the keyboard moves the picture of a report through its stages, reads values off it, and turns a body in space")
def _(folder):
    slope = report_of(folder / "slope", "run", "slope", *SHORT_SLOPE)
    cube = report_of(folder / "cube", "run", "oedometer")
    with Browser() as browser:
        browser.open(slope)
        slider = browser.find("input[type=range]")
        assert "t = 4 s, 3 of 3" in slider.get_attribute("aria-valuetext")
        seen = {browser.picture()}
        for stage in ("t = 2 s, 2 of 3", "t = 0 s, 1 of 3"):
            slider.send_keys(Keys.ARROW_LEFT)
            assert stage in slider.get_attribute("aria-valuetext") and stage in browser.text("output")
            seen.add(browser.picture())
        assert len(seen) == 3
        browser.find("canvas.picture").send_keys(Keys.ARROW_DOWN)
        assert re.search(r"At \([\d.e−, ]+\) m: plastic strain = ", browser.text()), browser.text()
        fields = browser.find("select")
        before = browser.picture()
        fields.send_keys("mean stress")
        until(lambda: browser.picture() != before)

        browser.open(cube)
        before = browser.picture()
        browser.find("canvas.picture").send_keys(Keys.ARROW_RIGHT)
        assert browser.picture() != before
        assert browser.log() == []


@claim("a plot of a report reads values off and zooms by the keyboard and by dragging, with all plots of the history")
def _(folder):
    report = report_of(folder / "bar", "run", "bar")
    rows = (folder / "bar/history.csv").read_text().splitlines()
    second = dict(zip(rows[0].split(","), rows[2].split(",")))
    with Browser() as browser:
        browser.open(report)
        plots = browser.driver.find_elements(By.CSS_SELECTOR, "[aria-labelledby=history] .plot")
        legends = browser.driver.find_elements(By.CSS_SELECTOR, "[aria-labelledby=history] .legend")
        residual = 2  # after the two fields of the probes
        plots[residual].send_keys(Keys.HOME, Keys.ARROW_RIGHT)
        assert f"t [s] {float(second['t']):g}" in legends[residual].text, legends[residual].text
        assert f"residual {float(second['residual']):.6g}" in legends[residual].text, (legends[residual].text, second)

        def curves():
            return browser.run("return [...document.querySelectorAll('.plot canvas:first-of-type')].map((one) => one.toDataURL()).join()")

        whole = curves()
        plots[0].send_keys(Keys.HOME, "+")
        zoomed = curves()
        assert zoomed != whole
        plots[0].send_keys(Keys.ESCAPE)
        until(lambda: curves() == whole)
        for plot in (plots[0], plots[-1]):
            ActionChains(browser.driver).move_to_element(plot).click_and_hold().move_by_offset(60, 0).release().perform()
            until(lambda: curves() != whole)
            plot.find_element(By.XPATH, "../div[@class='tools']/button").click()
            until(lambda: curves() == whole)
        assert browser.log() == []


def titles_of(browser):
    """[(title, what its x is)] of the plots of a history."""
    titles = browser.driver.find_elements(By.CSS_SELECTOR, "[aria-labelledby=history] .chart h3")
    below = browser.driver.find_elements(By.CSS_SELECTOR, "[aria-labelledby=history] .dygraph-xlabel")
    return [(title.text, x.text) for title, x in zip(titles, below, strict=True)]


@claim("the plots of a report stand in the order in which a reader asks, with units: load against displacement, probes, forces, residual and energies, and none of what never changes")
def _(folder):
    of_wall = ("Force of wall [N]", "its displacement [m]")
    run = ["Residual ‖F − R‖/‖F‖", "Energies [J]", "Kinetic energy over external work"]
    expected = {
        report_of(folder / "bar", "run", "bar"): ["Displacement u [m]", "Stress [Pa]", run[0], "Error bound ‖u − u*‖/‖u‖", run[1]],
        report_of(folder / "slope", "run", "slope", *SHORT_SLOPE): [of_wall, "Force [N]", *run],  # no slope yet: no angle
        report_of(folder / "block", "run", "block_on_wall"): ["Displacement u [m]", "Velocity v [m/s]", "Force [N]", *run],
    }
    load = report_of(folder / "footing", "run", "footing_limit", 'probe=[{name="edge", at=[1.0, 3.9], fields=["u.y"]}]')
    newton = report_of(folder / "newton", "run", "ladder/rigid_punch", "grid.cells=[20, 20]")
    with Browser() as browser:
        for report, titles in expected.items():
            found = titles_of(browser.open(report))
            assert found == [title if isinstance(title, tuple) else (title, "t [s]") for title in titles], found
        found = titles_of(browser.open(load))
        driven = [("Load factor λ", "mean displacement along the loads [m]"), ("Displacement u [m]", "t [s]")]
        assert found == driven + [(title, "t [s]") for title in run], found
        rows = [row.split(",") for row in (load.parent / "history.csv").read_text().splitlines()]
        factor, q = (float(rows[-1][rows[0].index(f"load.{name}")]) for name in ("factor", "displacement"))
        browser.find("[aria-labelledby=history] .plot").send_keys(Keys.END)
        said = browser.text("[aria-labelledby=history] .legend").replace("−", "-")
        assert f"load.factor {factor:.6g}" in said and f"{q:.5e}".replace("e-0", "e-") in said, (said, factor, q)
        found = titles_of(browser.open(newton))
        titles = ["Force [N]", "Contact area [m²]", "Penetration [cells]", run[0], "Error bound ‖u − u*‖/‖u‖", run[1]]  # the work
        assert found == [(title, "steps of the solver") for title in titles], found
        assert browser.log() == []


@claim("a plot of the load in a report shows all of its way where the displacement goes back")
def _(folder):
    way = ("load.displacement='2e-4*min(t, 2-t)'", "stop.time=1.6", "stop.load_growth=0")
    with Browser() as browser:
        browser.open(report_of(folder / "out", "run", "footing_limit", *way))
        plot = browser.find("[aria-labelledby=history] .plot")
        labels = [label.text for label in plot.find_elements(By.CSS_SELECTOR, ".dygraph-axis-label-x")]
        assert max(float(label.replace("−", "-")) for label in labels) > 1.4e-4, labels
        plot.send_keys(Keys.END)
        said = browser.text("[aria-labelledby=history] .legend").replace("−", "-")
        assert re.search(r"\[m\] 8\.\d+e-5", said), said
        assert browser.log() == []


@claim("the picture of a report shows plastic strain first where something has yielded, and tells a slope angle only if a probe asks for it")
def _(folder):
    settings = ("grid.cells=[60, 33]", "stop.time=8", "output.stages=[0, 8]")
    asked = report_of(folder / "asked", "run", "slope", *settings)
    silent = report_of(folder / "silent", "run", "slope", *settings, "probe=[]")
    angle = json.loads((folder / "silent/summary.json").read_text())["stages"][-1]["slope_angle"]
    assert angle is not None
    with Browser() as browser:
        for report, told in ((asked, True), (silent, False)):
            browser.open(report)
            assert (f"slope angle {angle:.3g}°" in browser.text("output")) == told, browser.text("output")
            headings = browser.run("return [...document.querySelectorAll('h3, .facts th')].map((one) => one.textContent)")
            assert any("lope angle" in heading for heading in headings) == told, headings
            assert browser.run("return document.querySelector('select').selectedOptions[0].textContent") == "plastic strain"
        browser.open(report_of(folder / "elastic", "run", "oedometer"))
        assert browser.run("return document.querySelector('select').selectedOptions[0].textContent") == "displacement |u| [m]"


@claim("the faces of a body in space are lit in a report: its top is the brightest, in a colour near that of the bar")
def _(folder):
    with Browser() as browser:
        browser.open(report_of(folder / "cube", "run", "oedometer"))
        browser.find("select").send_keys("u.x")  # it is 0
        until(lambda: "u.x" in browser.text("canvas.picture ~ p ~ p"))
        # Shares of the box that the body takes on the canvas: the middle of its top, and places on its two sides.
        top, front, side = browser.run("""
          const canvas = document.querySelector("canvas.picture"), c = canvas.getContext("2d");
          const {width, height} = canvas, data = c.getImageData(0, 0, width, height).data;
          const at = (x, y) => [...data.slice(4 * (y * width + x), 4 * (y * width + x) + 3)];
          let box = [width, height, 0, 0];
          for (let y = 0; y < height; ++y) for (let x = 150; x < width - 150; ++x) {
            if (at(x, y).every((part) => part > 250)) continue;
            box = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
          }
          return [[0.5, 0.15], [0.3, 0.6], [0.8, 0.6]].map(([x, y]) =>
            at(Math.round(box[0] + x * (box[2] - box[0])), Math.round(box[1] + y * (box[3] - box[1]))));""")
        assert sum(top) > 1.15 * sum(front) and sum(front) > 1.1 * sum(side), (top, front, side)
        bar = browser.run("return getComputedStyle(document.querySelector('.bar')).backgroundImage")
        colours = [[int(part) for part in found] for found in re.findall(r"rgb\((\d+), (\d+), (\d+)\)", bar)]
        assert min(max(abs(a - b) for a, b in zip(top, colour)) for colour in colours) < 45, (top, colours[0])


@claim("a plot of errors in a report has thin lines of the orders beside them")
def _(folder):
    report = report_of(folder / "converge", "converge", "mms_bar", "grid.basis=quadratic")
    grey = """const canvas = document.querySelector(".plot canvas"), c = canvas.getContext("2d");
      const {width, height} = canvas, data = c.getImageData(80, 0, width - 80, height - 60).data;
      let found = 0;
      for (let k = 0; k < data.length; k += 4)
        found += data[k + 3] > 80 && Math.hypot(data[k] - 0x59, data[k + 1] - 0x62, data[k + 2] - 0x6e) < 12;
      return found;"""
    with Browser() as browser:
        count = browser.open(report).run(grey)
        assert count > 500, count  # the width of the plot, twice
        assert browser.log() == []


@claim("a click or a key on a heading of a report's table sorts it by numbers, and once more the other way round")
def _(folder):
    with Browser() as browser:
        for report, column in (
            (report_of(folder / "compare", "compare", "bar"), "evaluations"),
            (report_of(folder / "converge", "converge", "mms_bar"), "points"),
        ):
            browser.open(report)
            table = browser.find("table.sortable")
            heads = table.find_elements(By.CSS_SELECTOR, "thead th")
            number = [head.text.strip(" ▲▼") for head in heads].index(column)

            def values():
                return browser.run(
                    """return [...arguments[0].querySelectorAll("tbody tr")].map((row) => row.children[arguments[1]].textContent)""",
                    table,
                    number,
                )

            def numbers():
                return [float(value.replace("\u202f", "").replace("\u00a0", "").replace(" ", "")) for value in values()]

            button = heads[number].find_element(By.TAG_NAME, "button")
            button.click()
            assert numbers() == sorted(numbers()) and len(set(numbers())) > 2, values()
            assert heads[number].get_attribute("aria-sort") == "ascending"
            button.send_keys(Keys.ENTER)
            assert numbers() == sorted(numbers(), reverse=True), values()
            assert heads[number].get_attribute("aria-sort") == "descending"
            assert browser.log() == []


@claim("a report begins with its verdict in words: equilibrium and its error bound, or what came before it, or that it failed")
def _(folder):
    good = report_of(folder / "good", "run", "bar")
    short = report_of(folder / "short", "run", "bar", "stop.steps=10", status=3)
    crushed = ("material.bar.law=neo-hookean", "force=[]", "support=[{at=0.0}, {at=10.0, u='-t'}]", "stop.time=20", "stop.residual=0")
    broken = report_of(folder / "broken", "run", "bar", *crushed, status=4)
    no_time = report_of(folder / "none", "run", "bar", "stop.wall_time=1e-9", status=3)
    bound = json.loads((folder / "good/summary.json").read_text())["distance"]
    expected = {
        good: ("✓ In equilibrium", f"within {bound:.2e}".replace("e-0", "e−"), "Against the exact solution", "Exit status 0"),
        short: ("! Not in equilibrium within the steps allowed", "stop.steps", "Exit status 3"),
        broken: ("✗ Diverged: this is no answer", "at t = ", "Exit status 4"),
        no_time: ("! Not in equilibrium within the wall time allowed", "stop.wall_time", "Exit status 3"),
    }
    with Browser() as browser:
        for report, words in expected.items():
            browser.open(report)
            first = browser.run("return document.querySelector('h1').nextElementSibling.innerText")
            assert all(word in first for word in words), (words, first)
            assert browser.log() == []


@claim("a report shows what its scene is called and says as text, whatever that is, with what was set")
def _(folder):
    nasty = "</script><script>document.title = 1</script><b>&amp; \\u2028 <!-- <script>"
    scene = folder / "scene.toml"
    text = (ROOT / "problems/bar.toml").read_text()
    scene.write_text(re.sub('(?m)^title = .*$', lambda _: f'title = "{nasty}"', text) + "\n# </pre><!-- <script> --!>\n")
    report = report_of(folder / "out", "run", scene, "damping.c=0.5")
    with Browser() as browser:
        browser.open(report)
        assert browser.log() == []
        assert browser.text("h1").split() == nasty.replace("\\u2028", "\u2028").split()
        assert browser.run("return document.querySelector('pre').textContent") == scene.read_text()
        assert "damping.c=0.5" in browser.text()
        assert "sundials" in browser.text() and "1 phase" in browser.text()


@claim("a report can be read without colour: lines differ in their dashes, markers differ in shape, and all is in words")
def _(folder):
    run = report_of(folder / "bar", "run", "bar")
    compare = report_of(folder / "compare", "compare", "bar")
    with Browser() as browser:
        browser.open(run)
        dashes = browser.run("""return [...document.querySelectorAll("#history ~ * .legend")].map((legend) =>
          [...legend.querySelectorAll("path")].map((path) => path.style.strokeDasharray))""")
        assert any(len(of_plot) == 2 for of_plot in dashes) and all(len(set(one)) == len(one) for one in dashes), dashes
        browser.open(compare)
        markers = browser.run("return [...document.querySelectorAll('.legend path')].map((path) => path.getAttribute('d'))")
        assert len(markers) == 6 == len(set(markers)), markers
        names = browser.run("""return [...document.querySelectorAll("input, select, canvas.picture, .plot")].filter((one) =>
          one.offsetParent && !one.getAttribute("aria-label") && !one.closest("label")).length""")
        assert names == 0


if __name__ == "__main__":
    check_the_claim()
