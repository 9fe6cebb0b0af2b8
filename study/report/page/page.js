// Puts the page together from its data.

const data = JSON.parse(document.getElementById("data").textContent);
const main = document.getElementById("main");

function findingItem(finding) {
    const item = element("li", {}, element("p", {}, element("strong", {}, finding.subject), ` – ${finding.text}`));
    if (finding.advice) item.append(element("p", {class: "advice"}, finding.advice));
    if (finding.figures) item.append(element("p", {class: "figures"}, finding.figures));
    return item;
}

function findingsOf(sections) {
    const part = element("section", {id: "findings", tabindex: "-1"}, element("h2", {}, "Findings"));
    for (const section of sections) {
        if (section.findings.length === 0) continue;
        part.append(element("h3", {}, element("a", {href: `#${section.id}`}, section.title)),
            element("ul", {class: "findings"}, ...section.findings.map(findingItem)));
    }
    return part;
}

function sectionPart(section) {
    const part = element("section", {id: section.id}, element("h2", {}, section.title),
        element("p", {class: "quiet"}, section.note));
    if (section.explorer) part.append(new Explorer(section.explorer, section.title).element);
    part.append(...section.heat_maps.map(heatFigure), ...section.charts.map(chartFigure));
    return part;
}

themeChoice.addEventListener("change", applyTheme);
darkSystem.addEventListener("change", applyTheme);
applyTheme();

document.getElementById("licence-text").textContent = document.getElementById("licences").textContent.trim();
document.getElementById("sources").textContent =
    `Made by rtusim ${data.version} from ${data.sources.map(source => `${source.file} (${source.kind})`).join(", ")}.`;
const links = [{id: "findings", title: "Findings"}, ...data.sections];
document.getElementById("contents").append(element("ul", {}, ...links.map(link =>
    element("li", {}, element("a", {href: `#${link.id}`}, link.title)))));
main.append(findingsOf(data.sections), ...data.sections.map(sectionPart));
