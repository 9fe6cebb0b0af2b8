// From a chart's table to what ECharts draws. Every drawn mark knows the row of the table that it stands for.

const symbols = ["circle", "rect", "triangle", "diamond"];
const dashes = ["solid", "dashed", "dotted"];

function distinct(values) { return [...new Set(values)]; }

// The series of a chart: [name, column of values, rows of the table]
function seriesOf(chart) {
    const all = chart.rows.map((row, i) => i);
    if (chart.group === null) return chart.values.map(value => [chart.columns[value].name, value, all]);
    return distinct(chart.rows.map(row => row[chart.group])).map(name =>
        [name, chart.values[0], all.filter(i => chart.rows[i][chart.group] === name)]);
}

// Pixels that a chart has across when the page is opened.
const openedWidth = Math.min(document.documentElement.clientWidth - 80, 1070);

function isSideways(chart, categories) {
    return categories.length > 2 && categories.join("  ").length * 8 > openedWidth - 60;
}

function barHeight(chart) {
    const categories = distinct(chart.rows.map(row => row[chart.x]));
    if (chart.kind === "matrix") return distinct(chart.rows.map(row => row[chart.group])).length * 17 + 190;
    if (!isSideways(chart, categories)) return 340;
    const bars = chart.kind === "stack" ? 1 : seriesOf(chart).length;
    return categories.length * (bars === 1 ? 22 : 10 + Math.max(4, 14 - bars) * bars) + 110;
}

function barOption(chart) {
    const categories = distinct(chart.rows.map(row => row[chart.x]));
    const sideways = isSideways(chart, categories);
    const names = seriesOf(chart);
    const colors = palettes[themeName()];
    const series = names.map(([name, value, rows]) => {
        const data = Array(categories.length).fill("-");
        for (const i of rows) {
            const number = chart.rows[i][value];
            const drawn = number === null || (chart.y_log && number <= 0) ? "-" : number;
            data[categories.indexOf(chart.rows[i][chart.x])] = {value: drawn, row: i};
        }
        const color = chart.kind === "stack" ? colors[accountColors[name]] : undefined;
        // On a logarithmic axis a bar has no length that means anything.
        return {name, type: chart.y_log ? "scatter" : "bar", symbolSize: 9, data, stack: chart.kind === "stack" ? "all" : undefined,
            itemStyle: color ? {color} : undefined, barMaxWidth: 36};
    });
    const category = axis({type: "category", data: categories, inverse: sideways, splitLine: {show: false}});
    category.axisLabel = {...category.axisLabel, interval: 0, hideOverlap: false,
        width: sideways ? Math.min(240, openedWidth / 3) : Math.floor((openedWidth - 80) / categories.length), overflow: sideways ? "truncate" : "break"};
    const value = axis({type: chart.y_log ? "log" : "value", name: chart.y_title, scale: chart.y_log});
    if (chart.kind === "stack" && chart.y_title.startsWith("%")) value.max = 100;
    if (!sideways) value.nameGap = 46;
    return {...baseOption(), series, xAxis: sideways ? value : category, yAxis: sideways ? category : value,
        legend: {...baseOption().legend, show: names.length > 1}};
}

function xyOption(chart) {
    const names = seriesOf(chart);
    const series = names.map(([name, value, rows], at) => {
        const turn = Math.floor(at / palettes.light.length);
        const data = rows.filter(i => chart.rows[i][chart.x] !== null && chart.rows[i][value] !== null)
            .map(i => ({value: [chart.rows[i][chart.x], chart.rows[i][value]], row: i}));
        const base = {name, data, symbol: symbols[turn % symbols.length], symbolSize: 8};
        return chart.kind === "lines"
            ? {...base, type: "line", lineStyle: {type: dashes[turn % dashes.length], width: 2}}
            : {...base, type: "scatter", itemStyle: {opacity: 0.8}};
    });
    return {...baseOption(), series,
        xAxis: axis({type: chart.x_log ? "log" : "value", name: chart.columns[chart.x].name, scale: true}),
        yAxis: axis({type: chart.y_log ? "log" : "value", name: chart.y_title, nameGap: 52, scale: chart.y_log}),
        legend: {...baseOption().legend, show: names.length > 1}};
}

function matrixOption(chart) {
    const columns = distinct(chart.rows.map(row => row[chart.x]));
    const lines = distinct(chart.rows.map(row => row[chart.group]));
    const scaled = value => chart.y_log ? Math.log10(value) : value;
    const data = [];
    chart.rows.forEach((row, i) => {
        const value = row[chart.values[0]];
        if (value === null || (chart.y_log && value <= 0)) return;
        data.push({value: [columns.indexOf(row[chart.x]), lines.indexOf(row[chart.group]), scaled(value)], row: i});
    });
    const values = data.map(item => item.value[2]);
    const category = {type: "category", splitLine: {show: true, lineStyle: {color: themeColor("--line")}}};
    const top = axis({...category, data: columns, position: "top"});
    top.axisLabel = {...top.axisLabel, rotate: 60, interval: 0, hideOverlap: false};
    const side = axis({...category, data: lines, inverse: true});
    side.axisLabel = {...side.axisLabel, interval: 0, hideOverlap: false};
    return {...baseOption(), legend: {show: false}, xAxis: top, yAxis: side,
        grid: {...baseOption().grid, top: 12, bottom: 60},
        visualMap: {min: values.length ? Math.min(...values) : 0, max: values.length ? Math.max(...values) : 1,
            calculable: true, orient: "horizontal", left: "center", bottom: 0, inRange: {color: scaleColors()},
            textStyle: {color: themeColor("--text")},
            formatter: value => numberText(chart.y_log ? 10 ** value : value, 0)},
        series: [{type: "heatmap", name: chart.y_title, data}]};
}

function heatOption(map, width, height) {
    // Whole pixels, where there is room for them: else cells have seams.
    const side = Math.floor(Math.min(width / map.columns, (height - 50) / map.rows));
    const size = side < 1 ? {right: 0, bottom: 50} : {width: side * map.columns, height: side * map.rows};
    const data = map.mean.map((value, i) => [i % map.columns, Math.floor(i / map.columns), value]);
    const hidden = {type: "category", show: false};
    const greatest = map.mean.reduce((a, b) => Math.max(a, b), 0);
    return {...baseOption(), legend: {show: false},
        grid: {left: 0, top: 0, ...size},
        xAxis: {...hidden, data: Array.from({length: map.columns}, (_, i) => i)},
        yAxis: {...hidden, inverse: true, data: Array.from({length: map.rows}, (_, i) => i)},
        visualMap: {min: 0, max: greatest || 1, calculable: true, orient: "horizontal", left: "center", bottom: 0,
            inRange: {color: scaleColors()}, textStyle: {color: themeColor("--text")}, precision: 0},
        series: [{type: "heatmap", name: map.title, data, progressive: 0,
            emphasis: {itemStyle: {borderColor: themeColor("--text"), borderWidth: 1}}}]};
}

function chartOption(chart) {
    if (chart.kind === "matrix") return matrixOption(chart);
    return chart.kind === "lines" || chart.kind === "points" ? xyOption(chart) : barOption(chart);
}
