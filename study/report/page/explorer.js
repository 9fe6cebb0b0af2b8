// The points of a sweep: filters, one field against another with the front of both, and parallel coordinates.

const fewValues = 12;
const fewNames = 24;
const maxParallelAxes = 10;
const maxTableRows = 200;

class Points {
    constructor(data) {
        this.fields = data.fields.map(field => ({...field, values: field.numbers ?? field.names,
            isNumber: field.numbers !== undefined}));
        for (const field of this.fields) {
            field.distinct = distinct(field.values).filter(value => value !== null)
                .sort((a, b) => field.isNumber ? a - b : a < b ? -1 : 1);
        }
        this.count = this.fields[0].values.length;
    }
    field(name) { return this.fields.find(field => field.name === name); }
    row(i) { return this.fields.map(field => field.values[i]); }
    columns() {
        return this.fields.map(field => ({name: field.name,
            decimals: field.isNumber && field.distinct.some(value => !Number.isInteger(value)) ? 2 : 0}));
    }
}

// Those that no other beats in both fields; of a field without a better end there is no front.
function frontOf(rows, x, y) {
    if (!x.better || !y.better) return [];
    const sign = field => field.better === "more" ? 1 : -1;
    const order = rows.filter(i => x.values[i] !== null && y.values[i] !== null).sort((a, b) =>
        sign(x) * (x.values[b] - x.values[a]) || sign(y) * (y.values[b] - y.values[a]) || a - b);
    const front = [];
    let best = -Infinity;
    for (let at = 0; at < order.length; ++at) {
        const y_value = sign(y) * y.values[order[at]];
        const last = front.at(-1);
        const equals = last !== undefined && x.values[last] === x.values[order[at]] &&
            y.values[last] === y.values[order[at]];
        if (y_value <= best && !equals) continue;
        best = Math.max(best, y_value);
        front.push(order[at]);
    }
    return front;
}

function mixed(from, to, share) {
    const part = (color, at) => parseInt(color.slice(1 + 2 * at, 3 + 2 * at), 16);
    return `rgb(${[0, 1, 2].map(at => Math.round(part(from, at) * (1 - share) + part(to, at) * share)).join(",")})`;
}

// A place between 0 and 1 on the scale of colours.
function scaleColor(share) {
    const colors = scaleColors();
    const at = Math.min(share * (colors.length - 1), colors.length - 1.0001);
    return mixed(colors[Math.floor(at)], colors[Math.floor(at) + 1], at % 1);
}

// The colour of a field's value: by its place among the field's values, so that large steps do not hide small ones.
function colorOf(field, value) {
    if (value === null) return themeColor("--line");
    const at = field.distinct.indexOf(value);
    if (!field.isNumber) return palettes[themeName()][at % palettes.light.length];
    return scaleColor(field.distinct.length > 1 ? at / (field.distinct.length - 1) : 0.5);
}

function checkboxes(field, changed) {
    const box = element("fieldset", {}, element("legend", {}, field.name));
    for (const value of field.distinct) {
        const input = element("input", {type: "checkbox"});
        input.checked = field.name !== "workload" || !field.distinct.includes("total") || value === "total";
        input.addEventListener("change", changed);
        input.shown = value;
        box.append(element("label", {}, input, ` ${cellText(value, 0)}`), " ");
    }
    const inputs = [...box.querySelectorAll("input")];
    return {box, accepts: () => {
        const allowed = new Set(inputs.filter(input => input.checked).map(input => input.shown));
        return i => allowed.has(field.values[i]) || (field.values[i] === null && allowed.size === inputs.length);
    }};
}

function range(field, changed) {
    const bound = (label, value) => element("input", {type: "number", step: "any", placeholder: String(value),
        "aria-label": `${field.name} ${label}`});
    const low = bound("at least", field.distinct[0]), high = bound("at most", field.distinct.at(-1));
    for (const input of [low, high]) input.addEventListener("input", changed);
    const box = element("fieldset", {}, element("legend", {}, field.name), low, " to ", high);
    return {box, accepts: () => {
        const from = low.value === "" ? -Infinity : Number(low.value);
        const to = high.value === "" ? Infinity : Number(high.value);
        return i => field.values[i] === null ? from === -Infinity && to === Infinity
            : field.values[i] >= from && field.values[i] <= to;
    }};
}

function filterOf(field, changed) {
    if (field.distinct.length < 2) return null;
    if (field.distinct.length <= (field.isNumber ? fewValues : fewNames)) return checkboxes(field, changed);
    return field.isNumber ? range(field, changed) : null;
}

function chooser(label, fields, chosen, changed) {
    const select = element("select", {"aria-label": label}, ...fields.map(field => element("option", {}, field.name)));
    select.value = chosen;
    select.addEventListener("change", changed);
    return {box: element("label", {}, `${label} `, select), name: () => select.value};
}

function isWide(field) {
    const low = field.distinct[0], high = field.distinct.at(-1);
    return field.is_parameter && field.isNumber && low > 0 && high / low >= 32;
}

function pointAxis(field, extra) {
    if (!field.isNumber) return axis({type: "category", data: field.distinct, name: field.name, ...extra});
    const better = field.better ? ` (${field.better} is better)` : "";
    return axis({type: isWide(field) ? "log" : "value", scale: true, name: field.name + better, ...extra});
}

class Explorer {
    constructor(data, title) {
        this.points = new Points(data);
        this.brushed = null;
        const changed = () => { this.brushed = null; this.later(); };
        const usable = this.points.fields.filter(field => field.isNumber || field.distinct.length <= fewNames);
        const numbers = usable.filter(field => field.isNumber);
        this.x = chooser("Across", usable, data.x, changed);
        this.y = chooser("Up", numbers, data.y, changed);
        this.color = chooser("Colour", usable, data.color, changed);
        this.filters = usable.map(field => filterOf(field, changed)).filter(filter => filter !== null);
        this.count = element("p", {class: "count", "aria-live": "polite"});
        this.legend = element("p", {class: "quiet"});
        this.table = tableDetails(this.points.columns(), () => this.tableRows(),
            `The first ${maxTableRows} of the points shown, the best upwards first.`);
        this.scatter = new ChartView({title: `${title}: one against another`,
            note: "The line joins those that no other shown point beats in both directions.", height: 440,
            option: () => this.scatterOption(), isLarge: true, withDetails: this.table,
            tip: mark => mark.data?.row === undefined ? null
                : rowTip(this.points.columns(), this.points.row(mark.data.row))});
        this.axes = this.parallelAxes();
        this.parallel = new ChartView({title: `${title}: parallel coordinates`,
            note: "A line is a point. Drag along an axis to select; the chart above then shows the selected points.",
            height: 380, least: 84 * this.axes.length, option: () => this.parallelOption(), isLarge: true, tip: () => null});
        const choose = element("div", {class: "choose"}, this.x.box, this.y.box, this.color.box);
        const filters = element("div", {class: "filters", role: "group", "aria-label": "Filters"},
            ...this.filters.map(filter => filter.box));
        this.element = element("div", {}, choose, filters, this.count, this.legend, this.scatter.figure,
            this.parallel.figure);
        const draw = this.parallel.draw.bind(this.parallel);
        this.parallel.draw = () => {
            const isNew = !this.parallel.chart;
            draw();
            if (isNew && this.parallel.chart) this.parallel.chart.on("axisareaselected", () => this.brush());
        };
        this.filter();
    }

    // Typing and clicking fast draws once.
    later() {
        if (this.isWaiting) return;
        this.isWaiting = true;
        requestAnimationFrame(() => {
            this.isWaiting = false;
            this.filter();
            this.scatter.redraw();
            this.parallel.redraw();
            this.table.refill();
        });
    }

    filter() {
        const accepts = this.filters.map(filter => filter.accepts());
        this.filtered = [];
        for (let i = 0; i < this.points.count; ++i) if (accepts.every(accept => accept(i))) this.filtered.push(i);
        this.say();
    }

    brush() {
        const chosen = this.parallel.chart.getModel().getSeriesByIndex(0).getRawIndicesByActiveState("active");
        const none = chosen.length === 0 || chosen.length === this.filtered.length;
        this.brushed = none ? null : chosen.map(at => this.filtered[at]);
        this.say();
        this.scatter.redraw();
        this.table.refill();
    }

    shown() { return this.brushed ?? this.filtered; }

    say() {
        const front = this.front();
        const text = front.length > 0 ? `, ${front.length} on the front of ${this.x.name()} and ${this.y.name()}` : "";
        this.count.textContent =
            `${this.shown().length.toLocaleString("en-US")} of ${this.points.count.toLocaleString("en-US")} points${text}`;
    }

    front() { return frontOf(this.shown(), this.points.field(this.x.name()), this.points.field(this.y.name())); }

    tableRows() {
        const y = this.points.field(this.y.name());
        const sign = y.better === "less" ? 1 : -1;
        return [...this.shown()].sort((a, b) => sign * (y.values[a] - y.values[b]) || a - b).slice(0, maxTableRows)
            .map(i => this.points.row(i));
    }

    sayColors(color) {
        this.legend.replaceChildren(`Colour, ${color.name}: `);
        const some = color.distinct.length <= fewNames ? color.distinct
            : [color.distinct[0], color.distinct[Math.floor(color.distinct.length / 2)], color.distinct.at(-1)];
        for (const value of some) {
            this.legend.append(element("span", {style: `color:${colorOf(color, value)}`, "aria-hidden": "true"}, "■"),
                ` ${cellText(value, 0)}  `);
        }
    }

    scatterOption() {
        const x = this.points.field(this.x.name()), y = this.points.field(this.y.name());
        const color = this.points.field(this.color.name());
        const colors = new Map(color.distinct.map(value => [value, colorOf(color, value)]));
        this.sayColors(color);
        const drawn = i => x.values[i] !== null && y.values[i] !== null;
        const size = this.shown().length > 3000 ? 5 : 9;
        const data = this.shown().filter(drawn).map(i => ({value: [x.values[i], y.values[i]], row: i,
            itemStyle: {color: colors.get(color.values[i]) ?? themeColor("--line")}}));
        const front = this.front().map(i => [x.values[i], y.values[i]]);
        return {...baseOption(), legend: {show: false}, xAxis: pointAxis(x, {}), yAxis: pointAxis(y, {nameGap: 56}),
            series: [{type: "scatter", name: "points", data, symbolSize: size, itemStyle: {opacity: 0.85},
                    emphasis: {scale: 1.6, itemStyle: {borderColor: themeColor("--text"), borderWidth: 2}}},
                {type: "line", name: "front", data: front, symbol: "none", silent: true, z: 1,
                    lineStyle: {color: themeColor("--text"), type: "dashed", width: 1.5}}]};
    }

    // Parameters first, then what came of them.
    parallelAxes() {
        const fits = field => field.distinct.length > 1 && field.name !== "workload" && field.name !== "design" &&
            (field.isNumber || field.distinct.length <= fewNames);
        const fields = this.points.fields.filter(fits);
        const parameters = fields.filter(field => field.is_parameter).slice(0, maxParallelAxes - 3);
        const results = fields.filter(field => !field.is_parameter);
        return [...parameters, ...results].slice(0, maxParallelAxes);
    }

    parallelOption() {
        const text = themeColor("--text");
        const color = this.points.field(this.color.name());
        const colors = new Map(color.distinct.map(value => [value, colorOf(color, value)]));
        const opacity = this.filtered.length > 500 ? 0.25 : 0.7;
        const data = this.filtered.map(i => ({value: this.axes.map(field => field.values[i] ?? "-"),
            lineStyle: {color: colors.get(color.values[i]) ?? themeColor("--line")}}));
        const parallelAxis = this.axes.map((field, dim) => ({dim, name: field.name, realtime: false,
            type: field.isNumber ? (isWide(field) ? "log" : "value") : "category",
            data: field.isNumber ? undefined : field.distinct, scale: true,
            nameTextStyle: {color: text}, axisLabel: {color: text},
            axisLine: {lineStyle: {color: themeColor("--quiet")}}}));
        return {...baseOption(), legend: {show: false}, parallelAxis,
            parallel: {left: 60, right: 110, top: 60, bottom: 24,
                parallelAxisDefault: {nameLocation: "end", nameGap: 16, nameRotate: 18,
                    nameTruncate: {maxWidth: 220}}},
            series: [{type: "parallel", data, lineStyle: {width: 1.5, opacity}, inactiveOpacity: 0.03,
                activeOpacity: 0.9}]};
    }
}
