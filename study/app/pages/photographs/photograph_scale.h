// The scale of the photographs: the width of one pixel in mm, typed, or computed from the width of the photograph, or measured
// with the ruler on the picture. The entry that was changed last counts.
#pragma once

#include <QImage>
#include <QWidget>
#include <optional>

class QLabel;
class QLineEdit;

namespace study::app {

class MessageBar;
class PhotographRuler;

class PhotographScale : public QWidget {
    Q_OBJECT
public:
    explicit PhotographScale(QWidget* parent);

    /// Shows the photograph under the ruler. `sizePx`: its own size.
    void setPhotograph(const QImage& picture, const QSize& sizePx, const QString& file);
    /// Width of one pixel; empty if unknown.
    std::optional<double> mmPerPixel() const { return m_mmPerPixel; }
    /// Moves the focus to an entry that is not valid. True if there is none.
    bool isValid();

Q_SIGNALS:
    void changed();

private:
    enum class From { Typed, Width, Ruler };
    void build();
    void take(From from);
    /// The width of one pixel by this entry, or the reason why there is none.
    void compute(From from);
    void refuse(QLineEdit& entry, const QString& text);
    void showResult();

    std::optional<double> m_mmPerPixel;
    QLineEdit* m_refused = nullptr;  ///< entry that is not valid
    From m_from = From::Typed;
    QLineEdit* m_scale;
    QLineEdit* m_width;
    QLineEdit* m_distance;
    PhotographRuler* m_ruler;
    QLabel* m_shown;
    QLabel* m_result;
    MessageBar* m_message;
};

}  // namespace study::app
