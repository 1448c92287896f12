#include "reports/documents/figure_object.h"

#include <algorithm>

#include "reports/documents/drawing_painter.h"

namespace reports {

int FigureObject::add(const Figure& figure)
{
    m_figures.push_back(&figure);
    return int(m_figures.size()) - 1;
}

QSizeF FigureObject::intrinsicSize(QTextDocument*, int, const QTextFormat& format)
{
    const std::string& svg = m_figures[std::size_t(format.intProperty(numberProperty))]->svg;
    const QSizeF own = drawingSize(svg);
    if (own.isEmpty()) return {};
    return own * std::min(m_width * shareOfTextWidth(svg) / own.width(), m_mostHeight / own.height());
}

void FigureObject::drawObject(QPainter* painter, const QRectF& place, QTextDocument*, int, const QTextFormat& format)
{
    paintDrawing(*painter, m_figures[std::size_t(format.intProperty(numberProperty))]->svg, place);
}

}  // namespace reports
