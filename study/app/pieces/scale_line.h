// The line of the Haptic Analog Scale that the participant memorises: equal sections between its two ends, no
// numbers but theirs. To look at while the scale is learned, perhaps with a mark to put a number to; to click,
// or move by the arrow keys, while a rating is entered.
#pragma once

#include <QWidget>
#include <optional>

#include "protocols/protocol.h"

namespace study::app {

class ScaleLine : public QWidget {
    Q_OBJECT
public:
    enum class Use { Show, Pick };
    ScaleLine(Use use, QWidget* parent);

    void setScale(const protocols::RatingScale& scale);
    /// Marks it, without a number.
    void setRating(std::optional<protocols::Tenths> rating);
    std::optional<protocols::Tenths> rating() const { return m_rating; }
    /// Where a rating lies on the widget; for tests that click.
    QPoint pointOf(protocols::Tenths rating) const;

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void ratingPicked(protocols::Tenths rating);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    QRectF line() const;
    void pickAt(double x);
    void pick(protocols::Tenths rating);
    void describe();

    Use m_use;
    protocols::RatingScale m_scale;
    std::optional<protocols::Tenths> m_rating;
};

}  // namespace study::app
