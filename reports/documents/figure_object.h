// A figure within the text of a QTextDocument.
#pragma once

#include <QObject>
#include <QTextObjectInterface>
#include <vector>

#include "reports/figures/figure.h"

namespace reports {

/// Draws figures by their number, the property of their character.
class FigureObject : public QObject, public QTextObjectInterface {
    Q_OBJECT
    Q_INTERFACES(QTextObjectInterface)

public:
    static constexpr int format = QTextFormat::UserObject + 1;
    static constexpr int numberProperty = QTextFormat::UserProperty + 1;

    /// `width`, of the text, and `mostHeight` in units of the page.
    FigureObject(double width, double mostHeight) : m_width(width), m_mostHeight(mostHeight) {}

    /// The figure must outlive the object. Returns its number.
    int add(const Figure& figure);

    QSizeF intrinsicSize(QTextDocument* document, int position, const QTextFormat& format) override;
    void drawObject(QPainter* painter, const QRectF& place, QTextDocument* document, int position,
                    const QTextFormat& format) override;

private:
    double m_width, m_mostHeight;
    std::vector<const Figure*> m_figures;
};

}  // namespace reports
