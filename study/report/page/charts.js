// A chart in its frame: drawn when it comes into view, again when colours or width change, and walked through with
// the arrow keys.

const views = [];

const inView = new IntersectionObserver(entries => {
    for (const entry of entries) if (entry.isIntersecting) entry.target.view.draw();
}, {rootMargin: "600px"});

const sizes = new ResizeObserver(entries => {
    for (const entry of entries) if (!isPrinting) entry.target.view.resize();
});

// `option` returns what is drawn, `tip` an element about a mark, or null for a mark without one.
class ChartView {
    constructor({title, note, height, least = 0, option, tip, isLarge = false, withDetails = null}) {
        this.option = option;
        this.tip = tip;
        this.isLarge = isLarge;
        this.chart = null;
        this.at = -1;
        this.div = element("div", {class: "chart", tabindex: "0", role: "img", style: `height:${height}px;min-width:${least}px`,
            "aria-label": `${title}. ${note} Arrow keys go through its marks.`});
        this.div.view = this;
        this.said = element("span", {class: "said", "aria-live": "polite"});
        this.figure = element("figure", {}, element("figcaption", {}, element("h3", {}, title),
            element("p", {}, note)), this.div, this.said);
        if (withDetails) this.figure.append(withDetails);
        this.div.addEventListener("keydown", event => this.walk(event));
        views.push(this);
        inView.observe(this.div);
        sizes.observe(this.div);
        themeListeners.push(() => this.redraw());
    }

    draw() {
        if (this.chart || this.div.clientWidth === 0) return;
        // SVG is crisp on paper; a canvas is faster with many marks.
        this.chart = echarts.init(this.div, null, {renderer: this.isLarge ? "canvas" : "svg"});
        this.redraw();
    }

    redraw() {
        if (!this.chart) return;
        const option = this.option();
        option.tooltip = {...option.tooltip, formatter: mark => this.tip(mark) ?? ""};
        this.chart.setOption(option, {notMerge: true});
    }

    // A resized chart is painted in the next frame, which on paper never comes: setting its option paints at once.
    resize(width = this.div.clientWidth) {
        if (!this.chart || this.chart.getWidth() === width) return;
        this.chart.resize({width});
        this.redraw();
    }

    // A canvas with thousands of cells comes out of a printer empty; a picture of it does not.
    toPaper() {
        if (!this.isLarge || !this.chart) return;
        this.picture ??= this.div.appendChild(element("img", {class: "paper", alt: ""}));
        this.picture.src = this.chart.getDataURL({pixelRatio: 2, backgroundColor: "#ffffff"});
    }

    marks() {
        return this.chart.getOption().series.flatMap((series, seriesIndex) => (series.data ?? [])
            .map((item, dataIndex) => ({seriesIndex, dataIndex, item}))
            .filter(({item}) => item !== "-" && item?.value !== "-"));
    }

    walk(event) {
        const steps = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1};
        if (event.key === "Escape") this.chart?.dispatchAction({type: "hideTip"});
        if (!(event.key in steps) || !this.chart) return;
        event.preventDefault();
        const marks = this.marks();
        if (marks.length === 0) return;
        this.at = (this.at + steps[event.key] + marks.length) % marks.length;
        const {seriesIndex, dataIndex, item} = marks[this.at];
        this.chart.dispatchAction({type: "showTip", seriesIndex, dataIndex});
        const spans = this.tip({data: item, dataIndex})?.querySelectorAll("span, b") ?? [];
        this.said.textContent = [...spans].map(part => part.textContent).join(" ");
    }
}

function chartFigure(chart) {
    const view = new ChartView({
        title: chart.title, note: chart.note,
        height: chart.kind === "lines" || chart.kind === "points" ? 400 : barHeight(chart),
        option: () => chartOption(chart),
        tip: mark => mark.data?.row === undefined ? null : rowTip(chart.columns, chart.rows[mark.data.row]),
        isLarge: chart.rows.length > 1000,
        withDetails: tableDetails(chart.columns, () => chart.rows),
    });
    return view.figure;
}

function heatFigure(map) {
    const side = map.pixels === 1 ? "a pixel" : `${map.pixels} x ${map.pixels} pixels`;
    const columns = [{name: "x, pixels", decimals: 0}, {name: "y, pixels", decimals: 0},
        {name: "Mean", decimals: 1}, {name: "Greatest", decimals: 0}];
    const row = i => [i % map.columns * map.pixels, Math.floor(i / map.columns) * map.pixels, map.mean[i],
        map.greatest[i]];
    const order = map.greatest.map((_, i) => i).sort((a, b) => map.greatest[b] - map.greatest[a] || a - b);
    const shown = Math.min(order.length, 100);
    const width = Math.min(openedWidth, 960);
    const view = new ChartView({
        title: map.title,
        note: `A cell is ${side}; its colour is the mean. Drag the ends of the scale to see a range only.`,
        height: Math.max(120, Math.round(width * map.rows / map.columns)) + 50,
        option: () => heatOption(map, view.chart.getWidth(), view.chart.getHeight()),
        tip: mark => rowTip(columns, row(mark.dataIndex)),
        isLarge: true,
        withDetails: tableDetails(columns, () => order.slice(0, shown).map(row), `The ${shown} greatest cells.`),
    });
    return view.figure;
}

window.addEventListener("beforeprint", () => {
    views.forEach(view => view.draw());
    setPrinting(true);
    views.forEach(view => { view.resize(680); view.toPaper(); });
});
window.addEventListener("afterprint", () => {
    setPrinting(false);
    views.forEach(view => view.resize());
});
