#include "study/app/pieces/flow_layout.h"

#include <QWidget>
#include <algorithm>
#include <cmath>

namespace study::app {

FlowLayout::FlowLayout(int gapPx, int rowGapPx, QWidget* parent)
    : QLayout(parent), m_usualGapPx(gapPx), m_usualRowGapPx(rowGapPx), m_gapPx(gapPx), m_rowGapPx(rowGapPx)
{
    setContentsMargins(0, 0, 0, 0);
}

FlowLayout::~FlowLayout() = default;

void FlowLayout::setScale(double scale)
{
    const int gapPx = static_cast<int>(std::lround(m_usualGapPx * scale));
    const int rowGapPx = static_cast<int>(std::lround(m_usualRowGapPx * scale));
    if (gapPx == m_gapPx && rowGapPx == m_rowGapPx) return;
    m_gapPx = gapPx;
    m_rowGapPx = rowGapPx;
    invalidate();
}

void FlowLayout::addItem(QLayoutItem* item) { m_items.emplace_back(item); }

QLayoutItem* FlowLayout::itemAt(int index) const
{
    return index >= 0 && index < count() ? m_items[static_cast<std::size_t>(index)].get() : nullptr;
}

QLayoutItem* FlowLayout::takeAt(int index)
{
    if (index < 0 || index >= count()) return nullptr;
    QLayoutItem* taken = m_items[static_cast<std::size_t>(index)].release();
    m_items.erase(m_items.begin() + index);
    return taken;
}

int FlowLayout::heightForWidth(int width) const { return place(QRect(0, 0, width, 0), Placing::Try); }

QSize FlowLayout::sizeHint() const
{
    QSize hint;
    for (const auto& item : m_items)
        if (!item->isEmpty())
            hint = QSize(hint.width() + item->sizeHint().width() + (hint.isEmpty() ? 0 : m_gapPx),
                         std::max(hint.height(), item->sizeHint().height()));
    return hint;
}

QSize FlowLayout::minimumSize() const
{
    QSize largest;
    for (const auto& item : m_items)
        if (!item->isEmpty()) largest = largest.expandedTo(item->minimumSize());
    return largest;
}

void FlowLayout::setGeometry(const QRect& rect)
{
    QLayout::setGeometry(rect);
    place(rect, Placing::Do);
}

int FlowLayout::place(const QRect& rect, Placing placing) const
{
    int top = rect.y(), right = rect.x(), height = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < m_items.size(); ++i) {
        if (m_items[i]->isEmpty()) continue;
        const QSize wanted = m_items[i]->sizeHint();
        if (right > rect.x() && right + wanted.width() > rect.right() + 1) {
            if (placing == Placing::Do) placeRow(rect, first, i, top, height);
            top += height + m_rowGapPx;
            right = rect.x();
            height = 0;
            first = i;
        }
        right += wanted.width() + m_gapPx;
        height = std::max(height, wanted.height());
    }
    if (placing == Placing::Do) placeRow(rect, first, m_items.size(), top, height);
    return top + height - rect.y();
}

void FlowLayout::placeRow(const QRect& rect, std::size_t first, std::size_t end, int top, int height) const
{
    int left = rect.x();
    for (std::size_t i = first; i < end; ++i) {
        if (m_items[i]->isEmpty()) continue;
        const QSize wanted = m_items[i]->sizeHint();
        const int width = std::min(wanted.width(), rect.width());
        m_items[i]->setGeometry(QRect(left, top + (height - wanted.height()) / 2, width, wanted.height()));
        left += width + m_gapPx;
    }
}

}  // namespace study::app
