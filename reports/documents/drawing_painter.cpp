#include "reports/documents/drawing_painter.h"

#include <QFontMetricsF>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QXmlStreamReader>
#include <algorithm>
#include <vector>

namespace reports {
namespace {

/// Text of one style within a line.
struct Span {
    QString text;
    QFont font;
    double dx = 0, dy = 0;
};

class DrawingReader {
public:
    DrawingReader(QPainter& painter, const std::string& svg) : m_painter(painter), m_xml(QByteArray::fromStdString(svg)) {}

    void paint()
    {
        while (!m_xml.atEnd()) {
            if (m_xml.readNext() != QXmlStreamReader::StartElement) continue;
            const QStringView name = m_xml.name();
            if (name == u"line") paintLine();
            if (name == u"polyline") paintPoints(false);
            if (name == u"polygon") paintPoints(true);
            if (name == u"rect") paintRectangle();
            if (name == u"circle") paintCircle();
            if (name == u"text") paintText();
            if (name == u"image") paintImage();
            if (name == u"title" || name == u"desc") m_xml.skipCurrentElement();
        }
    }

private:
    QString attribute(const char* name) const { return m_xml.attributes().value(QLatin1String(name)).toString(); }
    double number(const char* name) const { return attribute(name).toDouble(); }

    QPen pen() const
    {
        const QString stroke = attribute("stroke");
        if (stroke.isEmpty() || stroke == "none") return Qt::NoPen;
        const double width = attribute("stroke-width").isEmpty() ? 1 : number("stroke-width");
        QPen pen(QColor(stroke), width, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin);
        QList<qreal> dashes;
        for (const QString& length : attribute("stroke-dasharray").split(' ', Qt::SkipEmptyParts))
            dashes.push_back(length.toDouble() / width);
        if (!dashes.isEmpty()) pen.setDashPattern(dashes);
        return pen;
    }

    QBrush brush() const
    {
        const QString fill = attribute("fill");
        if (fill == "none") return Qt::NoBrush;
        QColor colour(fill.isEmpty() ? QString("#000000") : fill);
        if (const QString opacity = attribute("fill-opacity"); !opacity.isEmpty()) colour.setAlphaF(float(opacity.toDouble()));
        return colour;
    }

    void take()
    {
        m_painter.setPen(pen());
        m_painter.setBrush(brush());
    }

    void paintLine()
    {
        m_painter.setPen(pen());
        m_painter.drawLine(QPointF(number("x1"), number("y1")), QPointF(number("x2"), number("y2")));
    }

    void paintPoints(bool isClosed)
    {
        QPolygonF points;
        for (const QString& pair : attribute("points").split(' ', Qt::SkipEmptyParts))
            points << QPointF(pair.section(',', 0, 0).toDouble(), pair.section(',', 1, 1).toDouble());
        take();
        isClosed ? m_painter.drawPolygon(points) : m_painter.drawPolyline(points);
    }

    void paintRectangle()
    {
        take();
        m_painter.drawRect(QRectF(number("x"), number("y"), number("width"), number("height")));
    }

    void paintCircle()
    {
        take();
        m_painter.drawEllipse(QPointF(number("cx"), number("cy")), number("r"), number("r"));
    }

    void paintImage()
    {
        const QByteArray base64 = attribute("href").section(',', 1).toLatin1();
        const QImage image = QImage::fromData(QByteArray::fromBase64(base64), "PNG");
        m_painter.drawImage(QRectF(number("x"), number("y"), number("width"), number("height")), image);
    }

    void paintText()
    {
        const QString anchor = attribute("text-anchor"), transform = attribute("transform");
        const QPointF at(number("x"), number("y"));
        const QColor colour(attribute("fill"));
        QFont font;
        font.setPixelSize(std::max(1, int(std::lround(number("font-size")))));
        if (!attribute("font-weight").isEmpty()) font.setBold(true);
        const std::vector<Span> spans = spansOf(font);
        double width = 0;
        for (const Span& span : spans) width += span.dx + QFontMetricsF(span.font).horizontalAdvance(span.text);
        m_painter.save();
        m_painter.translate(at);
        if (transform.startsWith("rotate(")) m_painter.rotate(transform.mid(7).section(' ', 0, 0).toDouble());
        m_painter.setPen(colour);
        QPointF place(anchor == "middle" ? -width / 2 : anchor == "end" ? -width : 0, 0);
        for (const Span& span : spans) {
            place += QPointF(span.dx, span.dy);
            m_painter.setFont(span.font);
            m_painter.drawText(place, span.text);
            place.rx() += QFontMetricsF(span.font).horizontalAdvance(span.text);
        }
        m_painter.restore();
    }

    /// Reads to the end of the text element.
    std::vector<Span> spansOf(const QFont& plain)
    {
        std::vector<Span> spans;
        Span next{{}, plain};
        for (int depth = 1; depth > 0 && !m_xml.atEnd();) {
            const auto token = m_xml.readNext();
            if (token == QXmlStreamReader::StartElement) {
                ++depth;
                next = {{}, plain, number("dx"), number("dy")};
                if (attribute("font-style") == "italic") next.font.setItalic(true);
                if (attribute("font-weight") == "600") next.font.setBold(true);
                if (const QString size = attribute("font-size"); size.endsWith('%'))
                    next.font.setPixelSize(std::max(1, int(std::lround(plain.pixelSize() * size.chopped(1).toDouble() / 100))));
            } else if (token == QXmlStreamReader::EndElement) {
                --depth;
                next = {{}, plain};
            } else if (token == QXmlStreamReader::Characters && !m_xml.text().isEmpty()) {
                next.text = m_xml.text().toString();
                spans.push_back(next);
                next.dx = next.dy = 0;
            }
        }
        return spans;
    }

    QPainter& m_painter;
    QXmlStreamReader m_xml;
};

}  // namespace

QSizeF drawingSize(const std::string& svg)
{
    QXmlStreamReader xml(QByteArray::fromStdString(svg));
    if (!xml.readNextStartElement() || xml.name() != u"svg") return {};
    return {xml.attributes().value(QLatin1String("width")).toDouble(),
            xml.attributes().value(QLatin1String("height")).toDouble()};
}

double shareOfTextWidth(const std::string& svg)
{
    const QSizeF own = drawingSize(svg);
    return own.isEmpty() ? 1 : std::min(1.0, own.width() / fullDrawingWidth);
}

void paintDrawing(QPainter& painter, const std::string& svg, const QRectF& target)
{
    const QSizeF size = drawingSize(svg);
    if (size.isEmpty()) return;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(target.topLeft());
    painter.scale(target.width() / size.width(), target.height() / size.height());
    DrawingReader(painter, svg).paint();
    painter.restore();
}

}  // namespace reports
