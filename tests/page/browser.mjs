// What the tests of the report page share: Chromium, the program, and a page that fails on any error it logs.
// Arguments: the program, and the folder with playwright-core. Exit code 77, skipped, where a browser is missing.

import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdtempSync, rmSync} from "node:fs";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import path from "node:path";

const [program, modules] = process.argv.slice(2);
const browsers = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

function skip(reason) {
    console.log(`skipped: ${reason}`);
    process.exit(77);
}

function launcher() {
    if (Number(process.versions.node.split(".")[0]) < 20) skip(`node 20 is needed, this is ${process.version}`);
    const folder = path.join(modules, "playwright-core");
    if (!existsSync(folder)) skip("playwright-core is not installed (npm)");
    return createRequire(path.join(modules, "x.js"))("playwright-core").chromium;
}

export async function withBrowser(test) {
    const executablePath = browsers.find(existsSync) ?? skip("Chromium is not installed");
    const folder = mkdtempSync(path.join(tmpdir(), "rtusim_page_"));
    const browser = await launcher().launch({executablePath, args: ["--no-sandbox"]});
    try {
        await test({browser, folder, rtusim: (...args) => execFileSync(program, args, {cwd: folder, encoding: "utf8"})});
    } finally {
        await browser.close();
        rmSync(folder, {recursive: true});
    }
}

// Opens a file; `errors` gathers what goes wrong on the page, and what it asks of a network.
export async function openPage(browser, file, options = {}) {
    const page = await browser.newPage({viewport: {width: 1100, height: 900}, ...options});
    page.errors = [];
    page.setDefaultTimeout(30_000);
    page.on("pageerror", error => page.errors.push(error.message));
    page.on("console", message => { if (message.type() !== "log") page.errors.push(message.text()); });
    page.on("request", request => {
        if (!/^(file|data|blob):/.test(request.url())) page.errors.push(`asked for ${request.url()}`);
    });
    await page.goto(`file://${file}`);
    await page.evaluate(() => views.forEach(view => view.draw()));
    await settled(page);
    return page;
}

// When what was asked for has been painted.
export async function settled(page) {
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
}

// Colours of a canvas, or shapes of an SVG: what is on the screen, not what was meant to be.
export async function drawnMarks(page, at) {
    return page.evaluate(index => {
        const div = views[index].div;
        const canvas = div.querySelector("canvas");
        if (!canvas) return div.querySelectorAll("svg path[fill]:not([fill='none']), svg polyline").length;
        const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const colors = new Set();
        for (let i = 0; i < data.length; i += 4) {
            if (data[i + 3] > 40) colors.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
        }
        return colors.size;
    }, at);
}

// The text of the tooltip that is shown, or "".
export async function tooltip(page, at) {
    return page.evaluate(index => {
        const tip = views[index].div.querySelector(".tip");
        const box = tip?.parentElement;
        return box && getComputedStyle(box).visibility !== "hidden" && getComputedStyle(box).opacity !== "0"
            ? tip.textContent : "";
    }, at);
}

// Moves the mouse onto a mark of a chart.
export async function hover(page, at, series, item) {
    const place = await page.evaluate(([index, seriesIndex, dataIndex]) => {
        const view = views[index];
        view.div.scrollIntoView({block: "center"});
        const option = view.chart.getOption();
        const value = option.series[seriesIndex].data[dataIndex].value;
        const isPoint = Array.isArray(value);
        const sideways = option.yAxis[0].type === "category";
        // Of a bar: inside it, not at its end.
        const spot = isPoint ? value : sideways ? [value * 0.5, dataIndex] : [dataIndex, value * 0.5];
        const [x, y] = view.chart.convertToPixel({seriesIndex}, spot);
        const box = view.div.getBoundingClientRect();
        return [box.left + x, box.top + y];
    }, [at, series, item]);
    // Many marks are drawn in several steps, and the tooltip comes a moment later.
    for (let tries = 0; tries < 20 && await tooltip(page, at) === ""; ++tries) {
        await page.mouse.move(place[0] - 30, place[1] - 30);
        await page.mouse.move(...place);
        await page.waitForTimeout(150);
    }
}

export {assert};
