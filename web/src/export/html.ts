/** A report as one HTML file, fit to print. */

import type { Block, Report } from './report';

const STYLE = `
body { font: 12pt/1.45 'Times New Roman', 'Liberation Serif', serif; max-width: 18cm; margin: 1.5cm auto; padding: 0 1em; color: #000; background: #fff; }
h1 { font-size: 18pt; text-align: center; }
h2 { font-size: 14pt; margin-top: 1.5em; break-after: avoid; }
.lines { text-align: center; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { border: 0.5pt solid #666; padding: 3pt 6pt; text-align: left; vertical-align: top; }
tr, figure { break-inside: avoid; }
figure { margin: 1em 0; text-align: center; }
img { max-width: 100%; height: auto; }
.formula { text-align: center; font-style: italic; }
pre { font-size: 8.5pt; white-space: pre-wrap; border: 0.5pt solid #999; padding: 6pt; }
`;

export function toHtml({ title, language, lines, blocks }: Report): string {
  return `<!doctype html>
<html lang="${language}">
<head><meta charset="utf-8"><title>${escaped(title)}</title><style>${STYLE}</style></head>
<body>
<h1>${escaped(title)}</h1>
<p class="lines">${lines.map(escaped).join('<br>')}</p>
${blocks.map(block).join('\n')}
</body>
</html>
`;
}

function block(block: Block): string {
  switch (block.kind) {
    case 'heading':
      return `<h2>${escaped(block.text)}</h2>`;
    case 'paragraph':
      return `<p>${escaped(block.text)}</p>`;
    case 'formula':
      return `<p class="formula">${escaped(block.text)}</p>`;
    case 'code':
      return `<pre>${escaped(block.text)}</pre>`;
    case 'image':
      return `<figure><img src="data:image/png;base64,${base64(block.png)}" width="${block.width}" height="${block.height}" alt="${escaped(block.caption)}"></figure>`;
    case 'table': {
      const row = (cells: string[], tag: string) =>
        `<tr>${cells.map((cell) => `<${tag}>${escaped(cell)}</${tag}>`).join('')}</tr>`;
      return `<table><thead>${row(block.head, 'th')}</thead><tbody>${block.rows.map((cells) => row(cells, 'td')).join('\n')}</tbody></table>`;
    }
  }
}

function escaped(text: string): string {
  return text.replace(/[&<>"]/g, (character) => `&#${character.charCodeAt(0)};`);
}

function base64(bytes: Uint8Array): string {
  let binary = '';
  for (let start = 0; start < bytes.length; start += 0x8000) {
    binary += String.fromCharCode(...bytes.subarray(start, start + 0x8000));
  }
  return btoa(binary);
}
