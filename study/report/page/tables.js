// Elements, numbers and tables. Names come from files: they only ever become text, never markup.

function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
}

function numberText(value, decimals) {
    if (value !== 0 && Math.abs(value) < 0.5 * 10 ** -decimals) return value.toPrecision(3);
    return value.toLocaleString("en-US", {minimumFractionDigits: decimals, maximumFractionDigits: decimals});
}

function cellText(value, decimals) {
    if (value === null || value === undefined) return "–";
    return typeof value === "number" ? numberText(value, decimals) : value;
}

// A table that is made when it is first opened; `rows` is a function that returns them.
function tableDetails(columns, rows, note = "") {
    const details = element("details", {}, element("summary", {}, "Table"));
    const fill = () => {
        details.querySelector(".scroll")?.remove();
        const shown = rows();
        const isName = columns.map((_, i) => shown.some(row => typeof row[i] === "string"));
        const cells = (row, tag, text) => columns.map((column, i) =>
            element(tag, isName[i] ? {class: "name"} : {}, text(column, row[i])));
        const head = element("tr", {}, ...cells([], "th", column => column.name));
        const body = shown.map(row =>
            element("tr", {}, ...cells(row, "td", (column, value) => cellText(value, column.decimals))));
        details.append(element("div", {class: "scroll", tabindex: "0"}, note,
            element("table", {}, element("thead", {}, head), element("tbody", {}, ...body))));
    };
    details.addEventListener("toggle", () => { if (details.open) fill(); });
    details.refill = () => { if (details.open) fill(); };
    return details;
}

// What a tooltip shows of a row: every column.
function rowTip(columns, row) {
    const tip = element("div", {class: "tip"});
    columns.forEach((column, i) => {
        if (row[i] === null || row[i] === undefined) return;
        tip.append(element("span", {}, column.name), element("b", {}, cellText(row[i], column.decimals)));
    });
    return tip;
}
