// Light or dark: as the system says until the reader chooses; on paper always light.

const darkSystem = window.matchMedia("(prefers-color-scheme: dark)");
const themeChoice = document.getElementById("theme");
const themeListeners = [];
let isPrinting = false;

const palettes = {
    light: ["#0072b2", "#d55e00", "#009e73", "#b5578f", "#a87900", "#3a86c8", "#7a5195", "#8c6d31", "#6b7280"],
    dark: ["#56b4e9", "#ff8a3d", "#2fc39a", "#e69ac4", "#f2c14e", "#9ad0f5", "#b99ae0", "#c8b06a", "#9aa3af"],
};
// Busy, starved, blocked, idle: the same colours wherever these are drawn.
const accountColors = {Busy: 0, Starved: 4, Blocked: 1, Idle: 8};
// From little to much; every colour stands out from its background.
const scales = {
    light: ["#440154", "#3b528b", "#21918c", "#35a06b", "#8fb51a", "#d19a00"],
    dark: ["#7a63d6", "#4a86d0", "#2fa7a0", "#52c569", "#b5de2b", "#fde725"],
};

function themeName() {
    if (isPrinting) return "light";
    if (themeChoice.value !== "auto") return themeChoice.value;
    return darkSystem.matches ? "dark" : "light";
}

function themeColor(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function applyTheme() {
    document.documentElement.dataset.theme = themeName();
    themeListeners.forEach(listener => listener());
}

function setPrinting(value) {
    isPrinting = value;
    applyTheme();
}

function scaleColors() { return scales[themeName()]; }

// What all charts have in common.
function baseOption() {
    const text = themeColor("--text"), line = themeColor("--line");
    return {
        color: palettes[themeName()],
        animation: false,
        backgroundColor: "transparent",
        textStyle: {color: text, fontFamily: "system-ui, sans-serif"},
        tooltip: {
            trigger: "item", confine: true, backgroundColor: themeColor("--card"), borderColor: line,
            textStyle: {color: text},
        },
        legend: {type: "scroll", top: 0, textStyle: {color: text}, pageTextStyle: {color: text},
            inactiveColor: line, pageIconColor: text, pageIconInactiveColor: line},
        grid: {left: 12, right: 24, top: 40, bottom: 12, outerBoundsMode: "same", outerBoundsContain: "all"},
    };
}

function axis(extra) {
    const text = themeColor("--text"), line = themeColor("--line");
    return {
        nameLocation: "middle", nameGap: 30, nameTextStyle: {color: text},
        axisLabel: {color: text, hideOverlap: true}, axisLine: {lineStyle: {color: line}},
        axisTick: {lineStyle: {color: line}}, splitLine: {lineStyle: {color: line, opacity: 0.6}}, ...extra,
    };
}
