#include "study/app/pieces/appearance_keys.h"

#include <QApplication>
#include <QShortcut>
#include <QVariant>
#include <QWidget>

#include "study/app/state/recent_studies.h"

namespace study::app {

namespace {

/// The font before any appearance was applied: a second window must not enlarge what the first has enlarged.
QFont originalFont()
{
    constexpr char fontName[] = "vis2hapFont";
    if (!qApp->property(fontName).isValid()) qApp->setProperty(fontName, QApplication::font());
    return qApp->property(fontName).value<QFont>();
}

}  // namespace

AppearanceKeys::AppearanceKeys(std::shared_ptr<QSettings> settings, QWidget& window)
    : QObject(&window),
      m_settings(std::move(settings)),
      m_base(originalFont()),
      m_appearance(rememberedAppearance(m_settings.get()))
{
    const auto bind = [&](const QKeySequence& keys, auto work) {
        connect(new QShortcut(keys, &window), &QShortcut::activated, this, work);
    };
    bind(QKeySequence(Qt::CTRL | Qt::Key_Plus), [this] { set(larger(m_appearance)); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_Equal), [this] { set(larger(m_appearance)); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_Minus), [this] { set(smaller(m_appearance)); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_0), [this] { set({m_appearance.theme, 100}); });
    bind(QKeySequence(Qt::CTRL | Qt::Key_D), [this] {
        const bool isLight = m_appearance.theme == Theme::Light;
        set({isLight ? Theme::DarkRoom : Theme::Light, m_appearance.textPercent});
    });
    applyAppearance(m_appearance, m_base);
}

void AppearanceKeys::set(const Appearance& appearance)
{
    m_appearance = appearance;
    applyAppearance(appearance, m_base);
    rememberAppearance(m_settings.get(), appearance);
}

}  // namespace study::app
