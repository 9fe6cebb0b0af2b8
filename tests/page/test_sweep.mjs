// Sweeps of 1, 100 and 10,000 points in a browser: hovering shows the point that is there, filters leave the points
// that they should, the front is the front, and a change is on the screen soon.

import {writeFileSync} from "node:fs";
import path from "node:path";
import {assert, drawnMarks, hover, openPage, settled, tooltip, withBrowser} from "./browser.mjs";

const slots = [16, 32, 64, 128];

// Like an export of `rtusim sweep --json`; numbers that look random and are the same every time.
function points(count) {
    let state = 1;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
    return Array.from({length: count}, (_, i) => ({
        point: `p${i}`, design: `d${i}`, scene: "ball", workload: "total", preset: i % 2 ? "xe2" : "default",
        "rtu.ray_slots": slots[i % slots.length], "l1.size_bytes": 1024 + 64 * Math.floor(random() * 1000),
        cycles: 1000 + Math.floor(1e6 * random()), mrps: Number((1 + 99 * random()).toFixed(3)), bytes_per_ray: 500 * random(),
        l1_hit_percent: 100 * random(),
    }));
}

function bruteForceFront(rows) {
    const beats = (a, b) => a["l1.size_bytes"] <= b["l1.size_bytes"] && a.mrps >= b.mrps &&
        (a["l1.size_bytes"] < b["l1.size_bytes"] || a.mrps > b.mrps);
    return rows.filter(row => !rows.some(other => beats(other, row))).length;
}

const shownPoints = page => page.evaluate(() => views[0].chart.getOption().series[0].data.length);

async function choose(page, label, value) {
    await page.getByLabel(label, {exact: true}).selectOption(value);
    await settled(page);
}

async function checkPoint(page, rows) {
    const at = Math.floor(rows.length / 2);
    await hover(page, 0, 0, at);
    const shown = await tooltip(page, 0);
    // Another point may lie on top of it.
    const [, design] = /design(d\d+)/.exec(shown) ?? [];
    assert.ok(design, `tooltip '${shown}'`);
    if (rows.length <= 100) assert.equal(design, rows[at].design);
    assert.ok(shown.includes(rows[Number(design.slice(1))].mrps.toFixed(2)), shown);
}

async function checkFilters(page, rows) {
    const box = page.getByRole("group", {name: "rtu.ray_slots"}).getByLabel("64");
    const begin = Date.now();
    await box.uncheck();
    await settled(page);
    const took = Date.now() - begin;
    const left = rows.filter(row => row["rtu.ray_slots"] !== 64);
    assert.equal(await shownPoints(page), left.length);
    assert.match(await page.innerText(".count"), new RegExp(`^${left.length.toLocaleString("en-US")} of `));
    await page.getByLabel("mrps at least").fill("50");
    await settled(page);
    assert.equal(await shownPoints(page), left.filter(row => row.mrps >= 50).length);
    await page.getByLabel("mrps at least").fill("");
    await box.check();
    await settled(page);
    assert.equal(await shownPoints(page), rows.length);
    return took;
}

async function checkBrush(page) {
    const [left, top, bottom] = await page.evaluate(() => {
        const view = views[1];
        view.div.scrollIntoView({block: "center"});
        const box = view.div.getBoundingClientRect();
        return [box.left + 60, box.top + 60, box.bottom - 24];
    });
    await page.mouse.move(left, top + 5);
    await page.mouse.down();
    await page.mouse.move(left, (top + bottom) / 2, {steps: 4});
    await page.mouse.up();
    await page.waitForTimeout(200);
    const count = await page.innerText(".count");
    const [shown, all] = /([\d,]+) of ([\d,]+)/.exec(count).slice(1).map(text => Number(text.replaceAll(",", "")));
    assert.ok(shown > 0 && shown < all, `${count} after a selection on an axis`);
}

await withBrowser(async ({browser, folder, rtusim}) => {
    for (const count of [1, 100, 10_000]) {
        const rows = points(count);
        writeFileSync(path.join(folder, "sweep.json"), JSON.stringify(rows));
        rtusim("report", "sweep.json", "--html", "sweep.html");
        const begin = Date.now();
        const page = await openPage(browser, path.join(folder, "sweep.html"));
        const opened = Date.now() - begin;
        assert.ok(await drawnMarks(page, 0) >= 3);
        assert.equal(await shownPoints(page), count);
        let took = 0;
        if (count > 1) await choose(page, "Across", "l1.size_bytes");
        await checkPoint(page, rows);
        if (count > 1) {
            const front = Number(/, ([\d,]+) on the front/.exec(await page.innerText(".count"))[1]);
            if (count === 100) assert.equal(front, bruteForceFront(rows));
            assert.ok(await drawnMarks(page, 1) >= 3, "parallel coordinates");
            took = await checkFilters(page, rows);
            await checkBrush(page);
        }
        assert.deepEqual(page.errors, []);
        console.log(`${count} points: open and drawn in ${opened} ms, filtered in ${took} ms`);
        assert.ok(opened < 30_000 && took < 10_000, "responsive, even where other work takes the time");
        await page.close();
    }
});
