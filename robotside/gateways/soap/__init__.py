"""SOAP 1.1 on the robot's web site: typed operations with WSDL and XML Schema, publishers and subscribers."""
