#include "stats/anova/anova_effects.h"

#include "stats/kernels/distributions.h"

namespace stats {

AnovaEffect testedEffect(std::string name, const EffectSquares& squares, const ScaledSamples& scale)
{
    AnovaEffect effect;
    effect.name = std::move(name);
    effect.ss = scale.unscaledSquare(squares.effect);
    effect.ssError = scale.unscaledSquare(squares.error);
    effect.df1 = squares.df1;
    effect.df2 = squares.df2;
    effect.f = squares.effect / squares.df1 / (squares.error / squares.df2);
    const TailProbability tail = fisherUpper(*effect.f, squares.df1, squares.df2);
    effect.p = tail.p;
    effect.logP = tail.logP;
    effect.partialEtaSquared = squares.effect / (squares.effect + squares.error);
    effect.generalizedEtaSquared = squares.effect / (squares.effect + squares.generalError);
    return effect;
}

AnovaEffect untestedEffect(std::string name, const std::string& why)
{
    AnovaEffect effect;
    effect.name = std::move(name);
    effect.why = effect.mauchly.why = why;
    for (Value* value : {&effect.ss,
                         &effect.ssError,
                         &effect.df1,
                         &effect.df2,
                         &effect.f,
                         &effect.p,
                         &effect.logP,
                         &effect.partialEtaSquared,
                         &effect.generalizedEtaSquared,
                         &effect.epsilonGg,
                         &effect.pGg,
                         &effect.logPGg,
                         &effect.epsilonHf,
                         &effect.pHf,
                         &effect.logPHf,
                         &effect.mauchly.w,
                         &effect.mauchly.chiSquared,
                         &effect.mauchly.df,
                         &effect.mauchly.pChiSquared,
                         &effect.mauchly.pSecondOrder})
        *value = Value::undefined(why);
    return effect;
}

TwoWayAnova refusedAnova(TwoWayAnova anova, const std::string& why)
{
    anova.why = why;
    for (AnovaEffect& effect : anova.effects) effect = untestedEffect(effect.name, why);
    return anova;
}

}  // namespace stats
