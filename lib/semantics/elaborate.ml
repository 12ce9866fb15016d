let answer _ _ : (Core.closure, string) result = Error "stub"
