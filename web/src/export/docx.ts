/** A report as a Word document. The library is loaded when it is needed. */

import type { Report } from './report';

/** Width of the text in px, on A4 with usual margins. */
const TEXT_WIDTH = 600;

export async function toDocx({ title, lines, blocks }: Report): Promise<Blob> {
  const {
    AlignmentType,
    Document,
    HeadingLevel,
    ImageRun,
    Packer,
    Paragraph,
    Table,
    TableCell,
    TableRow,
    TextRun,
    WidthType,
  } = await import('docx');
  const cell = (text: string, bold = false) =>
    new TableCell({ children: [new Paragraph({ children: [new TextRun({ text, bold })] })] });
  const children = blocks.map((block) => {
    switch (block.kind) {
      case 'heading':
        return new Paragraph({ text: block.text, heading: HeadingLevel.HEADING_2, keepNext: true });
      case 'paragraph':
        return new Paragraph({ text: block.text });
      case 'formula':
        return new Paragraph({
          alignment: AlignmentType.CENTER,
          children: [new TextRun({ text: block.text, italics: true })],
        });
      case 'code':
        return new Paragraph({
          children: block.text
            .split('\n')
            .map((text, index) => new TextRun({ text, font: 'Courier New', size: 16, ...(index > 0 && { break: 1 }) })),
        });
      case 'image': {
        const scale = Math.min(1, TEXT_WIDTH / block.width);
        const transformation = { width: block.width * scale, height: block.height * scale };
        return new Paragraph({
          alignment: AlignmentType.CENTER,
          children: [new ImageRun({ type: 'png', data: block.png, transformation })],
        });
      }
      case 'table':
        return new Table({
          width: { size: 100, type: WidthType.PERCENTAGE },
          rows: [
            new TableRow({ tableHeader: true, children: block.head.map((text) => cell(text, true)) }),
            ...block.rows.map((cells) => new TableRow({ cantSplit: true, children: cells.map((text) => cell(text)) })),
          ],
        });
    }
  });
  const heading = [
    new Paragraph({ text: title, heading: HeadingLevel.TITLE, alignment: AlignmentType.CENTER }),
    ...lines.map((text) => new Paragraph({ text, alignment: AlignmentType.CENTER })),
  ];
  const document = new Document({
    title,
    creator: 'Isophote',
    styles: { default: { document: { run: { font: 'Times New Roman', size: 24 } } } },
    sections: [{ children: [...heading, ...children] }],
  });
  return Packer.toBlob(document);
}
