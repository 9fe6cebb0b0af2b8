// Every kind of result in a browser: each chart draws marks, answers mouse and keys, has its numbers beside it, and
// stays readable in dark, narrow and on paper.

import path from "node:path";
import {assert, drawnMarks, hover, openPage, settled, tooltip, withBrowser} from "./browser.mjs";

function makeResults(rtusim) {
    const small = ["--resolution", "24x24"];
    rtusim("run", ...small, "--json", "run.json", "--image", "out");
    rtusim("run", ...small, "--workload", "primary", "--set", "rtu.box.boxes_per_cycle=1", "--json", "one_lane.json");
    rtusim("area", "builtin", ...small, "--workload", "primary", "--json", "area.json");
    rtusim("stability", "--case", "shared_vertex", "--rays", "4", "--method", "wald,woop,rtu,exact", "--json",
        "stability.json");
    rtusim("stream", "--rays", "16", "--pairs", "16", "--json", "stream.json");
    const results = ["run.json", "one_lane.json", "out/builtin_box_tests.json", "area.json", "stability.json",
        "stream.json"];
    rtusim("report", ...results, "--html", "page.html");
    return results.length;
}

async function checkEveryChart(page) {
    const count = await page.evaluate(() => views.length);
    assert.ok(count >= 15, `${count} charts`);
    for (let at = 0; at < count; ++at) {
        const title = await page.evaluate(index => views[index].figure.querySelector("h3").textContent, at);
        assert.ok(await drawnMarks(page, at) >= 3, `${title}: nothing is drawn`);
        const table = await page.evaluate(index => {
            const details = views[index].figure.querySelector("details");
            details.open = true;
            details.refill();
            return [...details.querySelectorAll("tbody tr")].length;
        }, at);
        assert.ok(table > 0, `${title}: no table`);
    }
}

// The bar of box cycles, and the same by the keyboard.
async function checkMouseAndKeys(page) {
    const at = await page.evaluate(() => views.findIndex(view =>
        view.figure.querySelector("h3").textContent.endsWith("cycles of each unit")));
    const row = await page.evaluate(index => views[index].chart.getOption().series[0].data
        .findIndex(item => item.value > 50), at);
    await hover(page, at, 0, row);
    const shown = await tooltip(page, at);
    const expected = await page.evaluate(([index, i]) =>
        views[index].figure.querySelectorAll("tbody tr")[i].firstChild.textContent, [at, row]);
    assert.ok(shown.includes(expected) && shown.includes("Busy"), `tooltip '${shown}' of ${expected}`);
    await page.mouse.move(0, 0);
    await page.evaluate(index => views[index].div.focus(), at);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    await settled(page);
    const second = await page.evaluate(index =>
        views[index].figure.querySelectorAll("tbody tr")[1].firstChild.textContent, at);
    assert.ok((await tooltip(page, at)).includes(second), "arrow keys go through the marks");
    assert.ok((await page.evaluate(index => views[index].said.textContent, at)).includes(second), "and say them");
}

async function checkColours(page) {
    const back = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await back();
    await page.selectOption("#theme", "dark");
    const dark = await back();
    assert.notEqual(light, dark);
    await page.selectOption("#theme", "auto");
    assert.equal(await back(), light);
    await page.emulateMedia({colorScheme: "dark"});
    await settled(page);
    assert.equal(await back(), dark, "as the system says");
    await page.emulateMedia({colorScheme: "light"});
}

async function checkWidthsAndPaper(page, folder) {
    await page.setViewportSize({width: 380, height: 800});
    await page.waitForTimeout(200);
    const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(wide <= inner, `${wide} px of page in a window of ${inner}`);
    await page.setViewportSize({width: 1100, height: 900});
    await page.emulateMedia({media: "print"});
    await settled(page);
    const flat = await page.evaluate(() => views.filter(view => view.div.getBoundingClientRect().height < 100).length);
    assert.equal(flat, 0, "charts have their height on paper");
    await page.emulateMedia({media: "screen"});
    await page.evaluate(() => window.addEventListener("beforeprint", () => {
        window.printed = views.map(view => view.chart.getWidth());
    }));
    await page.pdf({path: path.join(folder, "page.pdf"), format: "A4"});
    assert.ok((await page.evaluate(() => window.printed)).every(width => width <= 700), "and the width of a page");
}

await withBrowser(async ({browser, folder, rtusim}) => {
    const inputs = makeResults(rtusim);
    const page = await openPage(browser, path.join(folder, "page.html"), {colorScheme: "light"});
    assert.equal(await page.evaluate(() => data.sources.length), inputs);
    assert.match(await page.innerText("#findings"), /one_lane\): primary – The limit is the box unit: (8[5-9]|9[0-9]) %/);
    await checkEveryChart(page);
    await checkMouseAndKeys(page);
    await checkColours(page);
    await checkWidthsAndPaper(page, folder);
    assert.deepEqual(page.errors, []);
});
