let fault ~source ~tokens ~index ~acceptable =
  ignore acceptable;
  let token = tokens.(index) in
  Diagnostic.error (Token.at token) (Printf.sprintf "unexpected '%s'" (Token.text ~source token))
