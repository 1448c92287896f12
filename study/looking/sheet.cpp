#include "study/looking/sheet.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "protocols/files/errors.h"
#include "study/looking/map_panels.h"
#include "study/looking/trace_panels.h"

namespace study::looking {

namespace {

constexpr double edge = 16;     // around a card
constexpr double between = 14;  // cards, and the panels of a card

/// One signal of the sheet with its figures and warnings.
struct SignalCard {
    const SeenSignal& signal;
    SignalFacts facts;
    QStringList lines, warnings;
};

QStringList qtLines(const std::vector<std::string>& lines)
{
    QStringList list;
    for (const std::string& line : lines) list << QString::fromStdString(line);
    return list;
}

SignalCard cardOf(const SeenSignal& signal)
{
    const SignalFacts facts = factsOf(signal);
    return {signal, facts, qtLines(linesOf(signal, facts)), qtLines(warningsOf(signal, facts))};
}

/// Heights of the parts of a card, px; all cards of a sheet have the same.
struct CardHeights {
    double head = 0, picture = 0, relief = 0, profile = 0, facts = 0;
    double whole() const { return head + picture + relief + profile + facts + 4 * between + 2 * edge; }
};

double inner(const SheetStyle& style) { return style.columnPx - 2 * edge; }

double heightOf(const QString& text, const QFont& font, double width)
{
    return QFontMetricsF(font).boundingRect(QRectF(0, 0, width, 1e4), Qt::AlignLeft | Qt::TextWordWrap, text).height();
}

double factsHeight(const SignalCard& card, const SheetStyle& style)
{
    double height = heightOf(card.lines.join('\n'), fontOf(style), inner(style));
    for (const QString& warning : card.warnings) height += heightOf(warning, fontOf(style), inner(style) - 16) + 16;
    return height;
}

CardHeights heightsOf(const std::vector<SignalCard>& cards, const SheetStyle& style)
{
    CardHeights heights;
    heights.head = QFontMetricsF(fontOf(style, 1.15, true)).height() + QFontMetricsF(fontOf(style, 0.9)).height() + 6;
    heights.picture = inner(style) * 0.72;
    heights.relief = inner(style) * 0.52;
    heights.profile = inner(style) * 0.42;
    for (const SignalCard& card : cards) heights.facts = std::max(heights.facts, factsHeight(card, style));
    return heights;
}

void drawHead(QPainter& painter, const QRectF& place, const SeenSignal& signal, const SheetStyle& style)
{
    painter.setFont(fontOf(style, 1.15, true));
    painter.setPen(style.text);
    const QFontMetricsF bold(painter.font());
    painter.drawText(place, Qt::AlignLeft | Qt::AlignTop,
                     bold.elidedText(QString::fromStdString(signal.title), Qt::ElideMiddle, place.width()));
    painter.setFont(fontOf(style, 0.9));
    painter.setPen(style.quietText);
    const QFontMetricsF plain(painter.font());
    painter.drawText(place.adjusted(0, bold.height() + 2, 0, 0), Qt::AlignLeft | Qt::AlignTop,
                     plain.elidedText(QString::fromStdString(signal.kind), Qt::ElideRight, place.width()));
}

void drawFacts(QPainter& painter, QRectF place, const SignalCard& card, const SheetStyle& style)
{
    painter.setFont(fontOf(style));
    painter.setPen(style.text);
    const QString text = card.lines.join('\n');
    painter.drawText(place, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, text);
    place.setTop(place.top() + heightOf(text, painter.font(), place.width()));
    for (const QString& warning : card.warnings) {
        const double height = heightOf(warning, painter.font(), place.width() - 16) + 10;
        const QRectF box(place.left(), place.top() + 6, place.width(), height);
        painter.setPen(Qt::NoPen);
        painter.setBrush(style.attention);
        painter.drawRoundedRect(box, 6, 6);
        painter.setPen(style.onAttention);
        painter.drawText(box.adjusted(8, 5, -8, -5), Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, warning);
        place.setTop(box.bottom());
    }
}

/// Draws the three panels of a map or of a trace, from top to bottom.
void drawPanels(QPainter& painter, const QRectF& first, const QRectF& second, const QRectF& third, const SignalCard& card,
                const SheetStyle& style)
{
    if (const auto* map = std::get_if<SeenMap>(&card.signal.what)) {
        drawPicture(painter, first, *map, card.facts, style);
        drawRelief(painter, second, *map, style);
        drawProfile(painter, third, *map, style);
        return;
    }
    const auto& trace = std::get<SeenTrace>(card.signal.what);
    drawTrace(painter, first, trace, style);
    drawSpectrogram(painter, second, trace, style);
    drawSpectrum(painter, third, trace, style);
}

void drawCard(QPainter& painter, const QPointF& corner, const SignalCard& card, const CardHeights& heights,
              const SheetStyle& style)
{
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(style.line, 1));
    painter.setBrush(style.surface);
    painter.drawRoundedRect(QRectF(corner, QSizeF(style.columnPx, heights.whole())).adjusted(0.5, 0.5, -0.5, -0.5), 10, 10);
    painter.setRenderHint(QPainter::Antialiasing, false);
    double top = corner.y() + edge;
    const auto next = [&](double height) {
        const QRectF place(corner.x() + edge, top, inner(style), height);
        top += height + between;
        return place;
    };
    drawHead(painter, next(heights.head), card.signal, style);
    const QRectF first = next(heights.picture), second = next(heights.relief), third = next(heights.profile);
    drawPanels(painter, first, second, third, card, style);
    drawFacts(painter, next(heights.facts), card, style);
}

}  // namespace

QImage drawSheet(const std::vector<SeenSignal>& signals, const SheetStyle& style, int perRow)
{
    assert(!signals.empty() && perRow >= 1 && "a sheet needs at least one signal");
    std::vector<SignalCard> cards;
    for (const SeenSignal& signal : signals) cards.push_back(cardOf(signal));
    const CardHeights heights = heightsOf(cards, style);
    const int columns = std::min(perRow, static_cast<int>(cards.size()));
    const int rows = (static_cast<int>(cards.size()) + columns - 1) / columns;
    const QSizeF size(columns * (style.columnPx + between) + between, rows * (heights.whole() + between) + between);
    constexpr double largestPx = 32000;
    if (std::max(size.width(), size.height()) * style.pixelRatio > largestPx)
        throw protocols::badInput({"the sheet would have " + std::to_string(static_cast<int>(size.width() * style.pixelRatio)) +
                                       " × " + std::to_string(static_cast<int>(size.height() * style.pixelRatio)) + " px",
                                   "", "at most 32000 px per side", "name fewer files"});
    QImage sheet((size * style.pixelRatio).toSize(), QImage::Format_RGB32);
    sheet.setDevicePixelRatio(style.pixelRatio);
    sheet.fill(style.background);
    QPainter painter(&sheet);
    for (int i = 0; i < static_cast<int>(cards.size()); ++i) {
        const QPointF corner(between + (i % columns) * (style.columnPx + between),
                             between + (i / columns) * (heights.whole() + between));
        drawCard(painter, corner, cards[static_cast<std::size_t>(i)], heights, style);
    }
    return sheet;
}

QString describe(const std::vector<SeenSignal>& signals)
{
    QStringList texts;
    for (const SeenSignal& signal : signals) {
        const SignalCard card = cardOf(signal);
        const QString facts = card.lines.join(QStringLiteral("; ")).replace(QStringLiteral("   "), QStringLiteral(", "));
        texts << QStringLiteral("%1 (%2): %3")
                         .arg(QString::fromStdString(signal.title), QString::fromStdString(signal.kind), facts) +
                     (card.warnings.isEmpty() ? QString() : QStringLiteral(". ") + card.warnings.join(' '));
    }
    return texts.join('\n');
}

}  // namespace study::looking
