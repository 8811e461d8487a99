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
        assert re.search(r"At \([\d.e−, ]+\) m: displacement \|u\| \[m\] = ", browser.text()), browser.text()
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
        plots[0].send_keys(Keys.HOME, Keys.ARROW_RIGHT)
        assert f"t [s] {float(second['t']):g}" in legends[0].text, legends[0].text
        assert f"residual {float(second['residual']):.6g}" in legends[0].text, (legends[0].text, second)

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
