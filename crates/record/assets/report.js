// Draws the plots of the case that is looked at, and sorts the table of cases.
"use strict";
(() => {
  const cases = JSON.parse(document.getElementById("plot-data").textContent);
  const sections = [...document.querySelectorAll(".case")];
  let drawn = [];
  let shown = 0;

  // 32-bit floats, little-endian, in base64. A gap is null.
  function numbers(base64) {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    return Array.from({ length: bytes.length / 4 }, (_, k) => {
      const value = view.getFloat32(4 * k, true);
      return Number.isFinite(value) ? value : null;
    });
  }

  // Lines are told apart by colour and by dash; the numbers of both have no common factor.
  const COLOURS = 8;
  const DASHES = [[], [8, 4], [2, 3], [12, 3, 2, 3], [4, 2], [16, 4], [8, 3, 2, 3, 2, 3]];

  function lineOf(k) {
    return { stroke: colour("line-" + (1 + (k % COLOURS))), dash: DASHES[k % DASHES.length] };
  }

  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  }

  function digits(value, count) {
    if (value == null) return "–";
    const size = Math.abs(value);
    if (value === 0) return "0";
    return size < 1e-3 || size >= 1e5 ? value.toExponential(count - 1) : value.toPrecision(count);
  }

  // Figures of an axis: plain where they are short, else with one exponent for all.
  function axisFigures(u, splits) {
    const largest = Math.max(...splits.map(Math.abs));
    const step = Math.abs(splits[1] - splits[0]) || 1;
    if (largest !== 0 && (largest < 1e-3 || largest >= 1e5)) {
      const places = Math.max(0, Math.min(3, Math.ceil(Math.log10(largest / step))));
      return splits.map((v) => (v === 0 ? "0" : v.toExponential(places).replace(/\.?0+e/, "e")));
    }
    let places = 0;
    while (places < 8 && Math.abs(step * 10 ** places - Math.round(step * 10 ** places)) > 1e-6) places += 1;
    return splits.map((v) => v.toFixed(places).replace(/^-(0\.?0*)$/, "$1"));
  }

  // A line that does not vary is drawn in the middle of its own plot. A limit widens the plot, but
  // one farther off than this many spans would squeeze the lines: it is told at the edge.
  const FAR = 1.5;

  function rangeWith(limits) {
    return (u, low, high) => {
      if (low == null) return [0, 1];
      const span = high - low || 2 * (Math.abs(low) || 1);
      const near = limits.filter((x) => x > low - FAR * span && x < high + FAR * span);
      if (low === high && !near.length) return [low - 0.5 * span, high + 0.5 * span];
      const [least, largest] = [Math.min(low, ...near), Math.max(high, ...near)];
      const pad = 0.06 * (largest - least || span);
      return [least - pad, largest + pad];
    };
  }

  function widthOf(u, figures) {
    const longest = (figures || []).reduce((n, text) => Math.max(n, text.length), 1);
    return 22 + 7 * longest;
  }

  // A dashed line at each event, with its number where there is room.
  function eventLines(events) {
    return (u) => {
      const { ctx, bbox } = u;
      const ratio = uPlot.pxRatio;
      let free = -Infinity;
      ctx.save();
      ctx.strokeStyle = ctx.fillStyle = colour("event");
      ctx.lineWidth = ratio;
      ctx.setLineDash([3 * ratio, 4 * ratio]);
      ctx.font = 10 * ratio + "px system-ui, sans-serif";
      ctx.textAlign = "left";
      ctx.textBaseline = "top";
      events.forEach((time, k) => {
        const x = u.valToPos(time, "x", true);
        if (!(x >= bbox.left - 1 && x <= bbox.left + bbox.width + 1)) return;
        ctx.beginPath();
        ctx.moveTo(x, bbox.top);
        ctx.lineTo(x, bbox.top + bbox.height);
        ctx.stroke();
        if (x > free) {
          const number = String(k + 1);
          ctx.fillText(number, x + 2 * ratio, bbox.top + ratio);
          free = x + 4 * ratio + ctx.measureText(number).width;
        }
      });
      ctx.restore();
    };
  }

  // Limits of requirements: a line over the time in which each binds, or a word at the edge.
  function limitLines(limits) {
    return (u) => {
      const { ctx, bbox } = u;
      const ratio = uPlot.pxRatio;
      const inside = (low, x, high) => Math.min(Math.max(x, low), high);
      const [right, bottom] = [bbox.left + bbox.width, bbox.top + bbox.height];
      const beyond = { above: 0, below: 0 };
      // On paper of their own: lines and numbers of events lie below.
      const say = (text, x, y) => {
        ctx.save();
        ctx.setLineDash([]);
        ctx.lineWidth = 4 * ratio;
        ctx.strokeStyle = colour("paper");
        ctx.strokeText(text, x, y);
        ctx.fillText(text, x, y);
        ctx.restore();
      };
      ctx.save();
      ctx.strokeStyle = ctx.fillStyle = colour("bad");
      ctx.lineWidth = 1.5 * ratio;
      ctx.setLineDash([5 * ratio, 3 * ratio]);
      ctx.font = 10 * ratio + "px system-ui, sans-serif";
      ctx.textAlign = "right";
      ctx.textBaseline = "bottom";
      limits.forEach((limit) => {
        const scale = "unit " + limit.unit;
        const [from, to] = [limit.from, limit.to].map((t) => inside(bbox.left, u.valToPos(t, "x", true), right));
        const y = u.valToPos(limit.value, scale, true);
        if (y < bbox.top || y > bottom) {
          const side = y < bbox.top ? "above" : "below";
          const line = 12 * ratio * (beyond[side] += limit.text ? 1 : 0);
          const text = limit.text && limit.text + (side === "above" ? " ↑" : " ↓");
          say(text, right - 3 * ratio, side === "above" ? bbox.top + line : bottom + 12 * ratio - line);
          return;
        }
        ctx.beginPath();
        ctx.moveTo(Math.min(from, to - 30 * ratio), y);
        ctx.lineTo(to, y);
        ctx.stroke();
        // Below the line where there is no room above it.
        const room = y - bbox.top > 14 * ratio;
        say(limit.text, to - 3 * ratio, room ? y - 2 * ratio : y + 13 * ratio);
      });
      ctx.restore();
    };
  }

  function axis(scale, label, more) {
    return {
      scale, label, labelSize: 18, labelGap: 0, gap: 4,
      font: "11px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif",
      stroke: colour("soft"), values: axisFigures,
      grid: { stroke: colour("grid"), width: 1 }, ticks: { stroke: colour("line"), width: 1, size: 4 },
      ...more,
    };
  }

  function options(lines, limits, events, width, more) {
    const units = [...new Set(lines.map((line) => line.unit))];
    const axes = [axis("x", "time (s)", { size: 26 })];
    const scales = { x: { time: false } };
    units.forEach((unit, k) => {
      const range = rangeWith(limits.filter((limit) => limit.unit === unit).map((limit) => limit.value));
      scales["unit " + unit] = { range };
      const side = k === 0 ? {} : { side: 1, grid: { show: false } };
      if (k < 2) axes.push(axis("unit " + unit, unit, { size: widthOf, ...side }));
    });
    const series = lines.map((line, k) => ({
      label: units.length > 1 ? line.label + " (" + line.unit + ")" : line.label,
      scale: "unit " + line.unit, width: 1.5, ...lineOf(k),
      value: (u, value) => digits(value, 5), ...more,
    }));
    return {
      width, height: 250, scales, axes,
      series: [{ label: "t (s)", value: (u, value) => digits(value, 5) }, ...series],
      cursor: { sync: { key: "time" }, points: { size: 6 } },
      hooks: { drawClear: [eventLines(events)], draw: [limitLines(limits)], ready: [markLines] },
    };
  }

  // In the legend stands a piece of each line.
  function markLines(u) {
    u.root.querySelectorAll(".u-series:not(:first-child) .u-marker").forEach((marker, k) => {
      const { stroke, dash } = lineOf(k);
      marker.removeAttribute("style");
      marker.innerHTML = '<svg width="30" height="6"><path d="M0 3H30" fill="none" stroke-width="2" stroke="'
        + stroke + '" stroke-dasharray="' + dash.join(" ") + '"/></svg>';
    });
  }

  function build(box, plot, events, width) {
    const units = [...new Set(plot.lines.map((line) => line.unit))];
    const part = document.createElement("div");
    const title = document.createElement("h4");
    title.textContent = plot.title + " ";
    const small = document.createElement("small");
    small.textContent = "(" + units.join(", ") + ")"
      + (plot.drawn < plot.samples ? " – " + plot.drawn + " of " + plot.samples + " samples drawn" : "");
    title.append(small);
    part.append(title);
    box.append(part);
    const data = [numbers(plot.time), ...plot.lines.map((line) => numbers(line.values))];
    const chart = new uPlot(options(plot.lines, plot.limits, events, width || part.clientWidth), data, part);
    drawn.push({ chart, part });
  }

  // One quantity of all cases in one plot; their samples need not be at the same times.
  function drawOverlay(width) {
    const name = overlaid && overlaid.value;
    const tables = [];
    const lines = [];
    cases.forEach((each) => each.plots.forEach((plot) => plot.lines.forEach((line) => {
      if (line.name !== name) return;
      tables.push([numbers(plot.time), numbers(line.values)]);
      lines.push({ label: each.name, unit: line.unit });
    })));
    if (!lines.length) return;
    const part = document.createElement("div");
    overlaid.closest("#overlay").append(part);
    const all = options(lines, [], [], width || part.clientWidth, { spanGaps: true, points: { show: false } });
    all.cursor.dataIdx = nearestSample;
    const chart = new uPlot(all, uPlot.join(tables), part);
    drawn.push({ chart, part });
  }

  // The legend shows each case's sample nearest to the cursor.
  function nearestSample(u, series, at) {
    const values = u.data[series];
    for (let away = 0; away < 100; away += 1) {
      if (values[at - away] != null) return at - away;
      if (values[at + away] != null) return at + away;
    }
    return at;
  }

  function overlayChooser() {
    const place = document.getElementById("overlay");
    const quantities = new Map();
    cases.forEach((each) => each.plots.forEach((plot) => plot.lines.forEach((line) => {
      quantities.set(line.name, plot.title + ": " + line.label + " (" + line.unit + ")");
    })));
    if (!place || !quantities.size) return null;
    const form = document.createElement("form");
    const label = document.createElement("label");
    const choice = document.createElement("select");
    quantities.forEach((text, name) => choice.append(new Option(text, name)));
    label.append("One quantity of all cases ", choice);
    form.append(label);
    place.append(form);
    choice.addEventListener("change", () => draw());
    return choice;
  }

  function draw(width) {
    drawn.forEach(({ chart, part }) => { chart.destroy(); part.remove(); });
    drawn = [];
    drawOverlay(width && 2 * width);
    const box = sections[shown] && sections[shown].querySelector(".plots");
    const data = cases[shown];
    if (!box || !data) return;
    box.querySelectorAll(".noscript").forEach((note) => note.remove());
    data.plots.forEach((plot) => build(box, plot, data.events, width));
  }

  function fit() {
    drawn.forEach(({ chart, part }) => {
      if (part.clientWidth && chart.width !== part.clientWidth) {
        chart.setSize({ width: part.clientWidth, height: chart.height });
      }
    });
  }

  const overlaid = overlayChooser();
  const select = document.querySelector("#chooser select");
  const links = [...document.querySelectorAll('.comparison a[href^="#case-"]')];

  function choose(id) {
    const found = sections.findIndex((section) => section.id === id);
    shown = Math.max(0, found);
    sections.forEach((section, k) => { section.hidden = k !== shown; });
    if (select) select.value = sections[shown].id;
    links.forEach((link) => {
      link.closest("tr").classList.toggle("chosen", link.hash === "#" + sections[shown].id);
    });
    draw();
  }

  // #case-3 and #case-3-events both choose case 3; other anchors leave the choice as it is.
  function caseInAddress() {
    const match = /^#(case-\d+)/.exec(location.hash);
    return match && match[1];
  }

  function followAddress() {
    const id = caseInAddress();
    if (!id) return;
    choose(id);
    const target = document.getElementById(location.hash.slice(1));
    if (target) target.scrollIntoView();
  }

  function sortable(table) {
    const body = table.tBodies[0];
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        [...table.tHead.rows[0].cells].forEach((other) => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        const sign = down ? -1 : 1;
        body.append(...[...body.rows].sort((a, b) => compare(a.cells[column], b.cells[column], sign)));
      });
    });
  }

  // Figures by value, words by alphabet; what is missing comes last either way.
  function compare(a, b, sign) {
    if (a.className !== "n") {
      return sign * a.textContent.localeCompare(b.textContent, undefined, { numeric: true });
    }
    const [left, right] = [a, b].map((cell) => Number.parseFloat(cell.textContent));
    if (Number.isNaN(left) || Number.isNaN(right)) return Number.isNaN(left) - Number.isNaN(right);
    return sign * (left - right);
  }

  document.querySelectorAll("table.comparison").forEach(sortable);
  if (sections.length) choose(caseInAddress() || sections[0].id);
  if (select) {
    select.addEventListener("change", () => {
      history.replaceState(null, "", "#" + select.value);
      choose(select.value);
    });
  }
  addEventListener("hashchange", followAddress);
  let waiting = 0;
  addEventListener("resize", () => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(fit);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => draw());
  // On paper: light colours, two plots side by side on A4 or letter.
  addEventListener("beforeprint", () => { document.documentElement.dataset.print = ""; draw(335); });
  addEventListener("afterprint", () => { delete document.documentElement.dataset.print; draw(); });
})();
