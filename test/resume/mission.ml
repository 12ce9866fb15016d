let source =
  {|radius = ask 'Radius? (km)'
v = pick { count 2; type 'UUV'; timeout 1.min }
post area: radius
inline = imcPlan { planName 'inline'; locate Location.APDL; skeeping duration: 8 }
there = imcPlan('out') >> inline >> action { post ready: 1 } >> imcPlan('back')
here = until { consume ready: 1 } run imcPlan('endless')
execute there | (here >> idle(0.2.seconds) >> imcPlan('around'))
setConnectionTimeout 2.min
execute during 1.min run imcPlan('home')
message 'Done!'
|}

let fleet =
  {|vehicle 'noptilus-1', { type 'UUV' }
vehicle 'noptilus-2', { type 'UUV' }
plan 'out', { duration 12 }
plan 'back', { duration 12 }
plan 'endless', { duration 100.hours }
plan 'around', { duration 16 }
plan 'home', { duration 8 }
|}

let plans = [ "out"; "inline"; "back"; "endless"; "around"; "home" ]
let stopped = "endless"
