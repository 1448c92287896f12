#include "study/app/pages/start_page.h"

#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <vector>

#include "study/app/language/fonts.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

StartPage::StartPage(QWidget* parent)
    : QWidget(parent),
      m_recentCaption(quietLabel("recentCaption", this)),
      m_recent(new QListWidget(this)),
      m_folder(field("studyFolderField", tr("Study folder"), this)),
      m_browse(button("browseStudyButton", tr("Browse…"), this)),
      m_open(mainButton("openButton", tr("Open the study (Enter)"), this)),
      m_monitor(button("monitorButton", tr("Watch the study…"), this)),
      m_new(button("newStudyButton", tr("Create a new study…"), this)),
      m_makeProtocol(button("makeProtocolButton", tr("Make a protocol…"), this)),
      m_changeProtocol(button("changeProtocolButton", tr("Change a protocol…"), this)),
      m_data(button("lookAtDataButton", tr("Look at a data set…"), this)),
      m_photographs(button("photographsButton", tr("Data set from photographs…"), this)),
      m_display(button("displayButton", tr("Display…"), this)),
      m_keys(button("keysButton", tr("Keys and pedals…"), this)),
      m_participant(button("participantScreenButton", tr("Participant's screen… (F4)"), this)),
      m_languageCaption(quietLabel("languageCaption", this, Type::Plain)),
      m_languages(new QComboBox(this)),
      m_reviewed(quietLabel("translationReview", this, Type::Plain)),
      m_firstSteps(label("firstSteps", Type::Body, this)),
      m_message(new MessageBar("startMessage", this))
{
    setObjectName("startPage");
    auto* page = new QWidget(this);
    auto* title = label("startTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("Vis2Hap"));
    auto* lead = label("startLead", Type::Lead, page);
    lead->setText(tr("Blinded studies of how rendered fabrics feel."));
    m_recentCaption->setText(tr("Recent studies"));
    name(*m_recent, "recentList", tr("Recent studies"));
    setType(*m_recent, Type::Body);
    m_recent->setTextElideMode(Qt::ElideMiddle);
    m_recent->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_recent->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    m_recent->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* caption = quietLabel("studyFolderCaption", page);
    caption->setText(tr("Study folder"));
    m_folder->setPlaceholderText(
        tr("the folder that contains study.db, or an address postgresql://USER@HOST/DATABASE?study=NAME"));

    auto* folderRow = new QHBoxLayout;
    folderRow->setSpacing(10);
    folderRow->addWidget(m_folder, 1);
    folderRow->addWidget(m_browse);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addStretch(1);
    column->addWidget(title);
    column->addWidget(lead);
    column->addSpacing(22);
    column->addWidget(m_recentCaption);
    column->addWidget(m_recent);
    column->addSpacing(8);
    column->addWidget(caption);
    column->addLayout(folderRow);
    column->addWidget(m_message);
    column->addWidget(m_firstSteps);
    column->addSpacing(10);
    column->addLayout(actionsRow(
        {m_open, m_monitor, m_new, m_makeProtocol, m_changeProtocol, m_photographs, m_data, m_display, m_keys, m_participant}));
    column->addStretch(2);
    m_languageCaption->setText(tr("Language"));
    for (QLabel* text : {m_languageCaption, m_reviewed}) text->setWordWrap(false);
    name(*m_languages, "languageList", tr("Language of this window"));
    setType(*m_languages, Type::Plain);
    column->addLayout(actionsRow({m_languageCaption, m_languages, m_reviewed}));
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("startArea", page, this));

    connect(m_folder, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    connect(m_open, &QPushButton::clicked, this, [this] { open(m_folder->text()); });
    connect(m_monitor, &QPushButton::clicked, this, [this] { open(m_folder->text(), &StartPage::monitorRequested); });
    connect(m_recent, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) { open(item->text()); });
    connect(m_recent, &QListWidget::currentTextChanged, this, [this](const QString& folder) {
        if (!folder.isEmpty()) m_folder->setText(folder);
    });
    connect(m_browse, &QPushButton::clicked, this, &StartPage::browse);
    connect(m_new, &QPushButton::clicked, this, &StartPage::newStudyRequested);
    connect(m_makeProtocol, &QPushButton::clicked, this, &StartPage::makeProtocolRequested);
    connect(m_changeProtocol, &QPushButton::clicked, this, &StartPage::changeProtocolRequested);
    connect(m_data, &QPushButton::clicked, this, &StartPage::dataRequested);
    connect(m_photographs, &QPushButton::clicked, this, &StartPage::photographsRequested);
    connect(m_display, &QPushButton::clicked, this, &StartPage::displayRequested);
    connect(m_keys, &QPushButton::clicked, this, &StartPage::keysRequested);
    connect(m_participant, &QPushButton::clicked, this, &StartPage::participantRequested);
    connect(m_languages, &QComboBox::activated, this,
            [this](int place) { Q_EMIT languageChosen(m_languages->itemData(place).toString()); });
    offerLanguages({});
}

void StartPage::offerLanguages(const Language& present)
{
    m_languages->clear();
    std::vector<Language> all = shippedLanguages();
    // A catalogue of the laboratory's own stands at the end.
    if (std::ranges::find(all, present.tag, &Language::tag) == all.end()) all.push_back(present);
    for (const Language& one : all) {
        const bool isWritable = missingFontPackage(one.tag).isEmpty();
        m_languages->addItem(isWritable ? one.name : nameInList(one.tag), one.tag);
    }
    m_languages->setCurrentIndex(m_languages->findData(present.tag));
    const bool isOriginal = present.tag == all.front().tag;
    m_reviewed->setVisible(!isOriginal);
    m_reviewed->setText(isOriginal                   ? QString()
                        : present.reviewer.isEmpty() ? tr("translation not reviewed")
                                                     : tr("translation reviewed by %1").arg(present.reviewer));
}

void StartPage::present(const QStringList& recentFolders, const Offered& offered)
{
    m_message->clearMessage();
    m_recent->clear();
    m_recent->addItems(recentFolders);
    m_recent->setVisible(!recentFolders.isEmpty());
    m_recentCaption->setVisible(!recentFolders.isEmpty());
    if (!recentFolders.isEmpty()) m_recent->setCurrentRow(0);
    showText(*m_firstSteps, recentFolders.isEmpty() && offered.newStudies && offered.photographs
                                ? tr("No study yet? Photographs of fabrics become a data set, and a data set becomes a study.")
                                : QString());
    for (QPushButton* work : {m_new, m_makeProtocol, m_changeProtocol}) work->setVisible(offered.newStudies);
    m_data->setVisible(offered.dataSets);
    m_photographs->setVisible(offered.photographs);
}

void StartPage::showFault(const QString& text) { m_message->showFault(text); }

void StartPage::focusFirst()
{
    if (m_recent->count() > 0)
        m_recent->setFocus();
    else
        m_folder->setFocus();
}

void StartPage::open(const QString& folder, void (StartPage::*request)(const QString&))
{
    m_message->clearMessage();
    if (folder.trimmed().isEmpty()) {
        m_folder->setFocus();
        m_message->showHint(tr("No folder is given. Type the study folder, or choose it with Browse."));
        return;
    }
    Q_EMIT(this->*request)(folder.trimmed());
}

void StartPage::browse()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Study folder"), m_folder->text());
    if (!chosen.isEmpty()) m_folder->setText(QDir::toNativeSeparators(chosen));
}

void StartPage::keyPressEvent(QKeyEvent* event)
{
    if (isEnter(event->key()) && focusWidget() == m_folder)
        open(m_folder->text());
    else if (auto* pressed = qobject_cast<QPushButton*>(focusWidget()); isEnter(event->key()) && pressed)
        pressed->click();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
