#include "study/app/pages/data_page.h"

#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QFontInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QShortcut>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "study/app/language/below.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/in_background.h"

namespace study::app {

namespace {

enum FabricColumn { idColumn, nameColumn, photographsColumn, framesColumn, heightsColumn, strokesColumn, faultsColumn, columns };

/// Thrown to stop a check whose result is no longer needed.
struct Stopped : std::runtime_error {
    Stopped() : std::runtime_error("stopped") {}
};

/// Number of lines that name files of this fabric.
int faultsOf(const QStringList& faults, const QString& folder, const QString& fabric)
{
    const QString place = QDir::cleanPath(folder + QLatin1Char('/') + fabric);
    return static_cast<int>(std::count_if(faults.begin(), faults.end(), [&](const QString& fault) {
        return fault.startsWith(place + QLatin1Char('/')) || fault.startsWith(place + QLatin1Char(':'));
    }));
}

Theme currentTheme()
{
    constexpr int halfLight = 128;
    return QApplication::palette().color(QPalette::Window).lightness() < halfLight ? Theme::DarkRoom : Theme::Light;
}

}  // namespace

DataPage::DataPage(const LookAtData& look, QWidget* parent)
    : QWidget(parent),
      m_look(look),
      m_folderField(field("dataFolderField", tr("Folder of the data set"), this)),
      m_browse(button("browseDataButton", tr("Browse…"), this)),
      m_open(mainButton("openDataButton", tr("Open the data set (Enter)"), this)),
      m_about(quietLabel("dataAbout", this, Type::Plain)),
      m_fabrics(new QTreeWidget(this)),
      m_checked(label("dataChecked", Type::Body, this)),
      m_faults(new QPlainTextEdit(this)),
      m_sampleLabel(label("sampleLabel", Type::Lead, this, Weight::Bold)),
      m_before(button("sampleBeforeButton", tr("Previous (Page Up)"), this)),
      m_after(button("sampleAfterButton", tr("Next (Page Down)"), this)),
      m_keys(quietLabel("dataKeys", this, Type::Plain)),
      m_sheet(new QLabel(this)),
      m_back(plainButton("dataBackButton", tr("Back (Esc)"), this)),
      m_message(new MessageBar("dataMessage", this)),
      m_reading(new InBackground(this)),
      m_drawing(new InBackground(this)),
      m_checking(new InBackground(this))
{
    setObjectName("dataPage");
    build();
    connect(m_folderField, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    connect(m_open, &QPushButton::clicked, this, [this] { open(m_folderField->text()); });
    connect(m_browse, &QPushButton::clicked, this, &DataPage::browse);
    connect(m_back, &QPushButton::clicked, this, &DataPage::backRequested);
    connect(m_before, &QPushButton::clicked, this, [this] { stepSample(-1); });
    connect(m_after, &QPushButton::clicked, this, [this] { stepSample(+1); });
    connect(m_fabrics, &QTreeWidget::currentItemChanged, this, &DataPage::chooseFabric);
    for (const auto& [key, step] : {std::pair(Qt::Key_PageUp, -1), std::pair(Qt::Key_PageDown, +1)}) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);  // otherwise the list handles these keys itself
        connect(shortcut, &QShortcut::activated, this, [this, step = step] { stepSample(step); });
        auto* scroll = new QShortcut(QKeySequence(Qt::CTRL | (step > 0 ? Qt::Key_Down : Qt::Key_Up)), this);
        scroll->setContext(Qt::WidgetWithChildrenShortcut);
        connect(scroll, &QShortcut::activated, this, [this, step = step] {
            QScrollBar* bar = m_area->verticalScrollBar();
            bar->setValue(bar->value() + step * bar->pageStep() / 3);
        });
    }
    enable();
}

DataPage::~DataPage()
{
    // The workers report to the widgets of this page, so stop them before the widgets are destroyed.
    for (InBackground* work : {m_checking, m_drawing, m_reading}) work->stop();
}

void DataPage::build()
{
    name(*m_fabrics, "dataFabrics", tr("Fabrics of the data set"));
    setType(*m_fabrics, Type::Plain);
    m_fabrics->setRootIsDecorated(false);
    m_fabrics->setAllColumnsShowFocus(true);
    m_fabrics->setHeaderLabels(
        {tr("Fabric"), tr("Name"), tr("Photographs"), tr("Frames"), tr("Heights"), tr("Strokes"), tr("Faults")});
    m_fabrics->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_fabrics->header()->setStretchLastSection(false);
    m_fabrics->header()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
    for (int column = photographsColumn; column < columns; ++column)
        m_fabrics->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    m_fabrics->header()->setFocusPolicy(Qt::NoFocus);
    m_fabrics->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    name(*m_faults, "dataFaults", tr("Faults found in the files"));
    setType(*m_faults, Type::Plain);
    m_faults->setReadOnly(true);
    m_faults->setTabChangesFocus(true);
    m_keys->setText(tr("Choose a fabric: arrow keys in the list   ·   scroll the page: Ctrl ↑ and Ctrl ↓"));
    m_sheet->setObjectName("dataSheet");
    m_sheet->setAlignment(Qt::AlignLeft | Qt::AlignTop);

    auto* page = new QWidget(this);
    auto* title = label("dataTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("Look at a data set"));
    auto* lead = quietLabel("dataLead", page);
    lead->setText(tr("Check the data before the first participant comes. This page shows bad presses and clipped images."));
    auto* folderRow = new QHBoxLayout;
    folderRow->setSpacing(10);
    folderRow->addWidget(m_folderField, 1);
    folderRow->addWidget(m_browse);
    m_folderField->setPlaceholderText(tr("the folder that contains dataset.json"));
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(title);
    column->addWidget(lead);
    column->addLayout(folderRow);
    column->addWidget(m_message);
    column->addLayout(actionsRow({m_open, m_back}));
    column->addWidget(m_about);
    column->addWidget(m_checked);
    column->addWidget(m_faults);
    column->addWidget(m_fabrics);
    column->addSpacing(8);
    column->addWidget(m_sampleLabel);
    column->addLayout(actionsRow({m_before, m_after}));
    column->addWidget(m_keys);
    column->addWidget(m_sheet);
    column->addStretch(1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    m_area = scrolling("dataArea", page, this);
    outer->addWidget(m_area);
    QWidget* const inOrder[] = {m_folderField, m_browse, m_open, m_back, m_faults, m_fabrics, m_before, m_after};
    for (std::size_t i = 1; i < std::size(inOrder); ++i) setTabOrder(inOrder[i - 1], inOrder[i]);
}

bool DataPage::isBusy() const { return m_reading->isBusy() || m_drawing->isBusy() || m_checking->isBusy() || m_isDrawingDue; }

void DataPage::focusFirst() { m_folderField->setFocus(); }

void DataPage::browse()
{
    const QString chosenFolder = QFileDialog::getExistingDirectory(this, tr("Fabric data set"), m_folderField->text());
    if (!chosenFolder.isEmpty()) m_folderField->setText(QDir::toNativeSeparators(chosenFolder));
}

void DataPage::open(const QString& asked)
{
    const QString folder = asked.trimmed();
    m_message->clearMessage();
    m_checking->stop();
    m_drawing->stop();
    m_isDrawnAgain = false;
    m_folder.clear();
    enable();
    if (folder.isEmpty()) {
        m_folderField->setFocus();
        return m_message->showHint(tr("No folder is given. Type the folder of the data set, or choose it with Browse."));
    }
    m_message->showDone(tr("The program reads the data set."));
    m_reading->run(
        [this, folder](const std::atomic<bool>&) -> InBackground::Then {
            return [this, folder, overview = m_look.open(folder.toStdString())] { showOverview(folder, overview); };
        },
        [this](const QString& why) { m_message->showFault(why); });
}

void DataPage::showOverview(const QString& folder, const DataOverview& overview)
{
    m_message->clearMessage();
    m_folder = folder;
    m_overview = overview;
    m_about->setText(tr("%1: %2").arg(overview.name, inOwnLanguage(overview.about)));
    m_fabrics->clear();
    for (const auto& fabric : overview.fabrics) {
        auto* row = new QTreeWidgetItem(m_fabrics);
        row->setText(idColumn, fabric.id);
        row->setText(nameColumn, fabric.structure.isEmpty() ? fabric.name : tr("%1 (%2)").arg(fabric.name, fabric.structure));
        const int counts[] = {fabric.photographs, fabric.frames, fabric.heights, fabric.strokes};
        for (int i = 0; i < 4; ++i) {
            row->setText(photographsColumn + i, QString::number(counts[i]));
            row->setTextAlignment(photographsColumn + i, Qt::AlignRight | Qt::AlignVCenter);
        }
    }
    m_fabrics->setCurrentItem(m_fabrics->topLevelItem(0));
    m_fabrics->setFocus();
    arrange();
    enable();
    checkFiles();
}

void DataPage::checkFiles()
{
    m_checked->setText(tr("The program checks every file."));
    m_faults->hide();
    const auto check = [this, folder = m_folder.toStdString()](const std::atomic<bool>& isStopping) -> InBackground::Then {
        const auto progress = [&](double share) {
            if (isStopping) throw Stopped();
            QMetaObject::invokeMethod(
                m_checked,
                [this, share] {
                    if (m_checking->isBusy())
                        m_checked->setText(tr("The program checks every file: %1 % done.").arg(static_cast<int>(100 * share)));
                },
                Qt::QueuedConnection);
        };
        return [this, faults = m_look.check(folder, progress)] { showFaults(faults); };
    };
    m_checking->run(check, [this](const QString& why) { showFaults({why}); });
}

void DataPage::showFaults(const QStringList& faults)
{
    m_checked->setText(faults.isEmpty() ? tr("All files are valid.") : tr("Faults found in the files: %1").arg(faults.size()));
    m_faults->setPlainText(faults.join('\n'));
    m_faults->setVisible(!faults.isEmpty());
    for (int row = 0; row < m_fabrics->topLevelItemCount(); ++row) {
        auto* item = m_fabrics->topLevelItem(row);
        item->setText(faultsColumn, QString::number(faultsOf(faults, m_folder, item->text(idColumn))));
        item->setTextAlignment(faultsColumn, Qt::AlignRight | Qt::AlignVCenter);
    }
    arrange();
}

const DataOverview::Fabric* DataPage::chosen() const
{
    const int row = m_fabrics->indexOfTopLevelItem(m_fabrics->currentItem());
    return m_folder.isEmpty() || row < 0 ? nullptr : &m_overview.fabrics.at(static_cast<std::size_t>(row));
}

void DataPage::chooseFabric()
{
    m_sample = 0;
    enable();
    draw();
}

void DataPage::stepSample(int step)
{
    const auto* fabric = chosen();
    if (!fabric || m_sample + step < 0 || m_sample + step >= fabric->samples) return;
    m_sample += step;
    enable();
    draw();
}

void DataPage::draw()
{
    m_isDrawingDue = false;
    const auto* fabric = chosen();
    if (!fabric || fabric->samples == 0) return;
    m_isDrawnAgain = m_drawing->isBusy();  // showSheet() then draws again instead of showing an outdated sheet
    if (m_isDrawnAgain) return;
    constexpr int marginsPx = 76;
    const DataSheetRequest request{.folder = m_folder.toStdString(),
                                   .fabric = fabric->id,
                                   .sample = m_sample,
                                   .theme = currentTheme(),
                                   .widthPx = std::min(width(), 1306) - marginsPx,
                                   .fontPx = QFontInfo(QApplication::font()).pixelSize() * factorOf(Type::Plain),
                                   .pixelRatio = devicePixelRatioF()};
    m_drawing->run(
        [this, request](const std::atomic<bool>&) -> InBackground::Then {
            return [this, sheet = m_look.draw(request)] { showSheet(sheet); };
        },
        [this](const QString& why) {
            showSheet({{}, {}, {why}});
        });
}

void DataPage::drawSoon()
{
    // Draws once at the end of resizing, not for every step of it.
    if (m_isDrawingDue || m_folder.isEmpty()) return;
    m_isDrawingDue = true;
    constexpr int restMs = 150;
    QTimer::singleShot(restMs, this, &DataPage::draw);
}

void DataPage::showSheet(const DataSheet& sheet)
{
    if (m_isDrawnAgain) return draw();
    m_sheet->setPixmap(QPixmap::fromImage(sheet.picture));
    m_sheet->setAccessibleName(sheet.description);
    m_sheet->setToolTip(sheet.description);
    if (sheet.faults.isEmpty())
        m_message->clearMessage();
    else
        m_message->showFault(sheet.faults.join('\n'));
}

void DataPage::arrange()
{
    const auto rowsOf = [this](int rows) { return m_fabrics->fontMetrics().height() * 2 * rows; };
    m_fabrics->setFixedHeight(rowsOf(std::clamp(m_fabrics->topLevelItemCount() + 1, 3, 8)));
    m_faults->setFixedHeight(m_faults->fontMetrics().height() * 5);
}

void DataPage::enable()
{
    const auto* fabric = chosen();
    const bool isOpen = !m_folder.isEmpty();
    for (QWidget* one : {static_cast<QWidget*>(m_about), static_cast<QWidget*>(m_fabrics), static_cast<QWidget*>(m_checked),
                         static_cast<QWidget*>(m_sheet)})
        one->setVisible(isOpen);
    if (!isOpen) m_faults->hide();
    for (QWidget* one : {static_cast<QWidget*>(m_sampleLabel), static_cast<QWidget*>(m_before), static_cast<QWidget*>(m_after),
                         static_cast<QWidget*>(m_keys)})
        one->setVisible(fabric != nullptr);
    if (!fabric) return;
    m_sampleLabel->setText(fabric->samples == 0
                               ? tr("%1: no samples").arg(fabric->id)
                               : tr("%1, sample %2 of %3").arg(fabric->id).arg(m_sample + 1).arg(fabric->samples));
    m_before->setEnabled(m_sample > 0);
    m_after->setEnabled(m_sample + 1 < fabric->samples);
    m_sheet->setVisible(fabric->samples > 0);
}

void DataPage::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange && event->type() != QEvent::FontChange) return;
    QMetaObject::invokeMethod(this, &DataPage::arrange, Qt::QueuedConnection);
    drawSoon();
}

void DataPage::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    if (event->oldSize().width() != event->size().width()) drawSoon();
}

void DataPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (isEnter(event->key()) && focusWidget() == m_folderField)
        open(m_folderField->text());
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
