let svg _ = ""
let html _ = ""
