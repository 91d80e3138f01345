// MathJax leaves code alone: a block named math becomes a formula before it looks at the page.
for (const block of document.querySelectorAll("code.language-math")) {
    const formula = document.createElement("div");
    formula.textContent = "\\[" + block.textContent + "\\]";
    (block.closest("pre") ?? block).replaceWith(formula);
}
