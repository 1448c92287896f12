// Line of the Haptic Analog Scale, which the participant memorises: equal sections, and numbers only at its two ends.
// Use::Show displays the line during scale training, with or without a mark. Use::Pick takes a rating by click or arrow keys.
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
    /// Marks the rating on the line, without its number.
    void setRating(std::optional<protocols::Tenths> rating);
    std::optional<protocols::Tenths> rating() const { return m_rating; }
    /// Point of a rating on the widget; for tests that click.
    QPoint pointOf(protocols::Tenths rating) const;
    const protocols::RatingScale& scale() const { return m_scale; }

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
