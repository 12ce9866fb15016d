// Made of lib/syntax/construct.ml: dune promote brings it up to date.

export const words = `
  task imcPlan mission action condition assert allOf when then oneOf choose waitFor until assure idle confirm during
  within run watch onError ignore propagate retry dismiss fail repeat recruit fresh ensure using def parameter if
  else while for in return break continue post consume poll message println release setConnectionTimeout pick ask
  pause getSupplier execute input halt onInterrupt`.trim().split(/\s+/);

export const constants = `
  true false null`.trim().split(/\s+/);
