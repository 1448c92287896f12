#include "study/app/pages/photographs/photograph_scale.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "protocols/files/typed_number.h"
#include "study/app/language/app_text.h"
#include "study/app/pages/photographs/photograph_ruler.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/photograph_steps.h"

namespace study::app {

namespace {

/// Millimetres as the operator types them, with a point or a comma.
std::optional<double> millimetresIn(const QLineEdit& entry)
{
    bool isNumber = false;
    const double mm = QString::fromStdString(protocols::typedNumber(entry.text().toStdString())).toDouble(&isNumber);
    return isNumber && std::isfinite(mm) ? std::optional(mm) : std::nullopt;
}

QString threeDigits(double mm) { return QString::number(mm, 'g', 3).replace(QLatin1Char('.'), decimalMark()); }

}  // namespace

PhotographScale::PhotographScale(QWidget* parent)
    : QWidget(parent),
      m_scale(field("pixelWidthField", tr("Width of one pixel, mm"), this)),
      m_width(field("photographWidthField", tr("Width of the photograph, mm"), this)),
      m_distance(field("rulerDistanceField", tr("Distance of the two points, mm"), this)),
      m_ruler(new PhotographRuler(this)),
      m_shown(quietLabel("rulerPhotograph", this, Type::Plain)),
      m_result(label("scaleResult", Type::Body, this, Weight::Bold)),
      m_message(new MessageBar("scaleMessage", this))
{
    build();
    connect(m_scale, &QLineEdit::textEdited, this, [this] { take(From::Typed); });
    connect(m_width, &QLineEdit::textEdited, this, [this] { take(From::Width); });
    connect(m_distance, &QLineEdit::textEdited, this, [this] { take(From::Ruler); });
    connect(m_ruler, &PhotographRuler::pointsChanged, this, [this] {
        if (m_ruler->lengthPx() || m_from == From::Ruler) take(From::Ruler);
    });
    showResult();
}

void PhotographScale::build()
{
    m_scale->setPlaceholderText(tr("not known"));
    m_width->setPlaceholderText(tr("not measured"));
    m_distance->setText(QStringLiteral("10"));
    auto* entries = new QVBoxLayout;
    entries->setSpacing(6);
    const auto addEntry = [&](const char* objectName, const QString& caption, QWidget* entry) {
        auto* text = quietLabel(objectName, this);
        text->setText(caption);
        entries->addWidget(text);
        entries->addWidget(entry);
    };
    addEntry("pixelWidthCaption", tr("Width of one pixel, mm"), m_scale);
    addEntry("photographWidthCaption", tr("or the width of the whole photograph, mm"), m_width);
    addEntry("rulerCaption", tr("or mark two points on the picture; their distance, mm"), m_distance);
    entries->addWidget(m_message);
    entries->addWidget(m_result);
    entries->addStretch(1);
    auto* picture = new QVBoxLayout;
    picture->setSpacing(6);
    auto* keys = quietLabel("rulerKeys", this, Type::Plain);
    keys->setText(tr("Click two points. By keys: arrows move the cross (Shift: in small steps), Space sets a point."));
    picture->addWidget(m_shown);
    picture->addWidget(m_ruler);
    picture->addWidget(keys);
    picture->addStretch(1);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(24);
    row->addLayout(entries, 2);
    row->addLayout(picture, 3);
}

void PhotographScale::setPhotograph(const QImage& picture, const QSize& sizePx, const QString& file)
{
    m_ruler->setPhotograph(picture, sizePx);
    showText(*m_shown, file);
    showResult();
}

void PhotographScale::take(From from)
{
    m_from = from;
    m_refused = nullptr;
    m_mmPerPixel.reset();
    m_message->clearMessage();
    compute(from);
    if (from != From::Typed) m_scale->setText(m_mmPerPixel ? QString::number(*m_mmPerPixel, 'g', 4) : QString());
    if (from != From::Width) m_width->clear();
    showResult();
    Q_EMIT changed();
}

void PhotographScale::compute(From from)
{
    QLineEdit& entry = from == From::Typed ? *m_scale : from == From::Width ? *m_width : *m_distance;
    const auto lengthPx = m_ruler->lengthPx();
    if (from == From::Ruler ? !lengthPx : entry.text().trimmed().isEmpty()) return;  // unknown
    const auto mm = millimetresIn(entry);
    if (!mm) return refuse(entry, tr("This is not a number. Type millimetres, such as 0.05 or 120."));
    if (*mm <= 0) return refuse(entry, tr("This length is not larger than 0. Type millimetres, such as 0.05 or 120."));
    const double pixels = from == From::Typed ? 1 : from == From::Width ? m_ruler->sizePx().width() : *lengthPx;
    if (pixels < 1) return refuse(entry, tr("The two points are at the same place. Mark points that lie far apart."));
    const double pitch = *mm / pixels;
    if (pitch < leastMmPerPixel || pitch > mostMmPerPixel)
        return refuse(entry, tr("One pixel would be %1 mm wide (expected %2 to %3 mm). Check the number and its unit.")
                                 .arg(threeDigits(pitch), threeDigits(leastMmPerPixel), threeDigits(mostMmPerPixel)));
    m_mmPerPixel = pitch;
}

void PhotographScale::refuse(QLineEdit& entry, const QString& text)
{
    m_refused = &entry;
    m_message->standBelow(entry);
    m_message->showFault(text);
}

bool PhotographScale::isValid()
{
    if (m_refused) m_refused->setFocus();
    return !m_refused;
}

void PhotographScale::showResult()
{
    const QSize size = m_ruler->sizePx();
    if (m_mmPerPixel)
        m_result->setText(tr("The picture shows %1 × %2 mm of fabric.")
                              .arg(threeDigits(size.width() * *m_mmPerPixel), threeDigits(size.height() * *m_mmPerPixel)));
    else
        m_result->setText(tr("The scale is not known. The program then assumes an ordinary weave."));
    m_result->setVisible(!m_refused);
}

}  // namespace study::app
